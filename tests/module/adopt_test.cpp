// Fragments that the device makes bodies of are the bodies that the host would make of them, and together they are and move as
// what they were parts of.
#include "modules/brittle/effects/blow.h"
#include "modules/brittle/mesh/primitives.h"
#include "tests/module/adopted_bodies.h"
#include "tests/support/solids.h"

#include <gtest/gtest.h>

#include <cstring>

namespace {

using adopting::densityOf, adopting::fragmentOf, adopting::momentsOf, adopting::placeOf, adopting::rotation, adopting::triple,
    adopting::vec, adopting::wayTo, adopting::wholeMass;
using adopting::Matrix3d, adopting::Vector3d;
using adopting::Object, adopting::Part, adopting::Scene, adopting::ToBreak, adopting::World;
using brittle::Double3, brittle::Fragment;

using uint = uint32_t;
#include "shaders-spirv/lib/hash.glsl"

// Second moments of a closed surface about the center of mass of its whole, by tetrahedra, as a tensor of inertia in the world.
Matrix3d wholeInertia(const Object& o) {
    const brittle::Mesh& mesh = o.model.prepared.mesh;
    Matrix3d second = Matrix3d::Zero();
    for (const brittle::Index3& t : mesh.triangles) {
        Vector3d c[4] = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
        for (size_t k = 0; k < 3; k++)
            c[3] += c[k] = wayTo(o, brittle::toDouble(mesh.positions[t[k]]));
        for (const Vector3d& v : c)
            second += c[0].dot(c[1].cross(c[2])) / 120 * v * v.transpose();
    }
    return densityOf(o) * (second.trace() * Matrix3d::Identity() - second);
}

// Sums over all fragments of an object, about the center of mass that it had, as seen by one who moves along with it.
struct Sums {
    double mass = 0, energy = 0;
    Vector3d balance = {0, 0, 0}, momentum = {0, 0, 0}, turning = {0, 0, 0};
};

Sums sumsOf(const Scene& scene, const World& world, uint32_t object) {
    Sums s;
    const gpu::BodyState& whole = scene.objects[object].state;
    for (const Part& part : scene.parts) {
        if (part.object != object) continue;
        const gpu::BodyState& b = world.bodies[part.room.x];
        const double m = 1 / double{b.offset.w};
        const Vector3d r = placeOf(b) - placeOf(whole), v = vec(b.velocity) - vec(whole.velocity);
        s.mass += m;
        s.balance += m * r;
        s.momentum += m * vec(b.velocity);
        s.turning += m * r.cross(v) + vec(b.momentum);
        s.energy += m * vec(b.velocity).squaredNorm() / 2 + vec(b.spin).dot(vec(b.momentum)) / 2;
    }
    return s;
}

void expectNothingLost(const Scene& scene, const World& world) {
    for (uint32_t k = 0; k < scene.objects.size(); k++) {
        const Object& o = scene.objects[k];
        const Sums s = sumsOf(scene, world, k);
        const double mass = wholeMass(o);
        const Vector3d v = vec(o.state.velocity), spin = vec(o.state.spin), turning = wholeInertia(o) * spin;
        EXPECT_NEAR(s.mass, mass, 1e-6 * mass);
        EXPECT_LE((s.balance / mass).norm(), 2e-6);
        EXPECT_LE((s.momentum - mass * v).norm(), 1e-5 * mass * v.norm());
        EXPECT_LE((s.turning - turning).norm(), 1e-5 * turning.norm());
        const double energy = mass * v.squaredNorm() / 2 + spin.dot(turning) / 2;
        EXPECT_NEAR(s.energy, energy, 1e-5 * energy);
    }
}

// As in the event, bit for bit, but for the unit; what breaks next finds what it wants to know of it.
void expectSurface(const Scene& scene, const World& world, const Part& part) {
    const Fragment& f = fragmentOf(scene, part);
    const gpu::BreakableBody& body = world.breakable[part.room.x];
    const brittle::FragmentVertex* from = &scene.objects[part.object].result.fragments.vertices[f.first_vertex];
    const brittle::FragmentVertex* to = &world.vertices[3ull * part.room.w];
    EXPECT_EQ(std::memcmp(from, to, f.vertex_count * sizeof *from), 0);
    const uint32_t own = f.outer_index_count - f.earlier_index_count;
    EXPECT_EQ(body.surface.x, 3 * part.room.w);
    EXPECT_EQ(body.surface.y, own);
    EXPECT_EQ(body.surface.z, f.vertex_count - own);
    EXPECT_EQ(body.surface.w, scene.objects[part.object].body.surface.w);
    for (size_t k = 0; k < 3; k++) {
        float low = from->position[k], high = low;
        for (uint32_t v = 0; v < f.vertex_count; v++) {
            low = std::min(low, from[v].position[k]);
            high = std::max(high, from[v].position[k]);
        }
        EXPECT_EQ((&body.low.x)[k], low);
        EXPECT_EQ((&body.high.x)[k], high);
    }
}

void expectForm(const Scene& scene, const World& world, const Part& part) {
    const Object& o = scene.objects[part.object];
    const Fragment& f = fragmentOf(scene, part);
    const gpu::BreakableBody& body = world.breakable[part.room.x];
    const gpu::BodyState& state = world.bodies[part.room.x];
    EXPECT_NEAR(body.form.x, f.volume, 1e-6 * f.volume);
    EXPECT_EQ(body.form.w, adopting::kHold);
    EXPECT_EQ(body.balance.w, adopting::kSteps);
    EXPECT_EQ(body.low.w, part.object);
    EXPECT_LE((vec(body.balance) - vec(f.centroid)).norm(), 1e-7 * vec(f.centroid).norm());
    // A place of the surface in the world, by the whole and by the fragment.
    const Vector3d corner = vec(positionOf(o.result.fragments.vertices[f.first_vertex]));
    const Vector3d here = placeOf(state) + rotation(state.turn) * (rotation(body.turn) * (corner - vec(body.balance)));
    EXPECT_LE((here - placeOf(o.state) - wayTo(o, triple(corner))).norm(), 1e-6 + 2e-6 * corner.norm());
}

double strengthBy(const Scene& scene, uint32_t number) {
    const Part& part = scene.parts[number];
    const gpu::BreakableBody& whole = scene.objects[part.object].body;
    uint32_t draw = mixed(mixed(part.object) ^ static_cast<uint32_t>(whole.balance.w));
    for (const int32_t x : adopting::siteOf(number))
        draw = mixed(draw + static_cast<uint32_t>(x));
    const auto& material = brittle::builtinMaterials()[whole.surface.w];
    return strengthOf(material, fragmentOf(scene, part).volume, brittle::chanceOf(adopting::kSeed, draw));
}

void expectBreakable(const Scene& scene, const World& world) {
    for (uint32_t k = 0; k < scene.parts.size(); k++) {
        SCOPED_TRACE("part " + std::to_string(k));
        expectSurface(scene, world, scene.parts[k]);
        expectForm(scene, world, scene.parts[k]);
        const double strength = strengthBy(scene, k);
        EXPECT_NEAR(world.breakable[scene.parts[k].room.x].form.z, strength, 1e-5 * strength);
    }
}

void expectAdopted(const Scene& scene) {
    const World world = adopting::adopt(scene);
    adopting::expectBodies(scene, world);
    expectNothingLost(scene, world);
    expectBreakable(scene, world);
}

ToBreak builtin(const std::string& name, uint32_t sites, double scale = 1) {
    const auto mesh = brittle::makeBuiltin(name);
    EXPECT_TRUE(mesh);
    return {whole::modelFrom(support::moved(*mesh, scale, {0, 0, 0})), sites, {}};
}
ToBreak boxOf(const Double3& size, uint32_t sites) { return {whole::modelFrom(whole::boxOf({0, 0, 0}, size)), sites, {}}; }

// A cube that breaks into so many cubes along each edge.
ToBreak cubes(uint32_t count) {
    ToBreak cube = boxOf({1, 1, 1}, 0);
    for (uint32_t k = 0; k < count * count * count; k++) {
        const uint32_t cell[3] = {k % count, k / count % count, k / (count * count)};
        cube.given.push_back({(cell[0] + 0.5) / count, (cell[1] + 0.5) / count, (cell[2] + 0.5) / count});
    }
    return cube;
}

// Broken once for all tests that look at it.
const Scene& twoThatBreak() {
    static const Scene kScene = [] {
        std::vector<ToBreak> objects;
        objects.push_back(builtin("ring", 5));
        objects.push_back(boxOf({1, 1, 1}, 6));
        return adopting::breakTogether(std::move(objects), 6);
    }();
    return kScene;
}

TEST(SmallAdopt, FragmentsAreTheBodiesThatTheHostWouldMake) { expectAdopted(twoThatBreak()); }

TEST(Adopt, HundredsOfFragments) {
    std::vector<ToBreak> objects;
    objects.push_back(builtin("icosphere", 100));
    objects.push_back(builtin("bumpy:3", 300));
    expectAdopted(adopting::breakTogether(std::move(objects)));
}

TEST(Adopt, SizesFromMillimetersToHundredsOfMeters) {
    std::vector<ToBreak> objects;
    objects.push_back(builtin("icosphere", 40, 1e-3));
    objects.push_back(builtin("icosphere", 40, 0.1));
    objects.push_back(builtin("icosphere", 40, 300));
    const Scene scene = adopting::breakTogether(std::move(objects), 2);
    const World world = adopting::adopt(scene);
    adopting::expectBodies(scene, world);
    expectBreakable(scene, world);
}

TEST(Adopt, ThinPlatesAndRods) {
    std::vector<ToBreak> objects;
    objects.push_back(boxOf({1, 2, 0.01}, 40));
    objects.push_back(boxOf({0.02, 2, 0.02}, 15));
    objects.push_back(boxOf({0.002, 0.001, 3}, 5));
    expectAdopted(adopting::breakTogether(std::move(objects), 3));
}

TEST(Adopt, CubesOfACubeKeepTheirAxes) {
    std::vector<ToBreak> objects;
    objects.push_back(cubes(3));
    const Scene scene = adopting::breakTogether(std::move(objects), 4);
    ASSERT_EQ(scene.parts.size(), 27u);
    expectAdopted(scene);
    const World world = adopting::adopt(scene);
    for (const Part& part : scene.parts)
        EXPECT_EQ(vec(world.breakable[part.room.x].turn), Vector3d(0, 0, 0));
}

// What was surface of an earlier fragment is told from its cut faces.
TEST(Adopt, FragmentsOfFragments) {
    const Scene first = adopting::breakTogether({builtin("icosphere", 5)}, 9);
    std::vector<ToBreak> objects;
    for (size_t f = 0; f < 3; f++)
        objects.push_back({whole::modelFrom(first.objects[0].result.fragments, f), 12, {}});
    const Scene scene = adopting::breakTogether(std::move(objects), 10);
    EXPECT_TRUE(std::ranges::any_of(scene.parts, [&](const Part& p) { return fragmentOf(scene, p).earlier_index_count != 0; }));
    expectAdopted(scene);
}

TEST(Adopt, ManyObjectsAtOnce) {
    std::vector<ToBreak> objects;
    for (uint32_t k = 0; k < 18; k++) // a second row of tiles
        objects.push_back(k % 2 == 0 ? builtin("ring", 9) : boxOf({1, 0.3, 0.2}, 10));
    expectAdopted(adopting::breakTogether(std::move(objects), 5));
}

// The same solid, askew in the frame of its vertices.
ToBreak askew(const Double3& size, uint32_t sites) {
    brittle::ImportedMesh mesh = whole::boxOf({0, 0, 0}, size);
    const Eigen::AngleAxisd turn(1.1, Vector3d(0.3, -0.5, 0.8).normalized());
    for (Double3& p : mesh.positions)
        p = triple(turn * vec(p));
    return {whole::modelFrom(mesh), sites, {}};
}

TEST(Adopt, PlatesAndRodsAskew) {
    std::vector<ToBreak> objects;
    objects.push_back(askew({1, 2, 0.02}, 40));
    objects.push_back(askew({0.05, 2, 0.04}, 15));
    expectAdopted(adopting::breakTogether(std::move(objects), 7));
}

// So thin that floats of second moments hardly tell their thickness: they are solids nevertheless, and about as thick as that.
TEST(Adopt, NeedlesAskewAreSolids) {
    constexpr double kThick[] = {5e-4, 2e-4, 2e-5};
    std::vector<ToBreak> objects;
    for (const double thick : kThick)
        objects.push_back(askew({thick, 2, thick}, 2));
    const Scene scene = adopting::breakTogether(std::move(objects), 8);
    const World world = adopting::adopt(scene);
    for (const Part& part : scene.parts) {
        SCOPED_TRACE(part.object);
        const gpu::BodyState& state = world.bodies[part.room.x];
        Vector3d moments = momentsOf(world.shapes[part.room.x]);
        std::ranges::sort(moments);
        const double thick = std::sqrt(6 * moments[0] * double{state.offset.w});
        EXPECT_GT(thick, kThick[part.object] / 2);
        EXPECT_LT(thick, std::max(2 * kThick[part.object], 4e-3));
        EXPECT_LE(moments[2], (moments[0] + moments[1]) * (1 + 1e-6));
        EXPECT_TRUE(vec(state.momentum).allFinite());
    }
}

TEST(SmallAdopt, BytesDoNotDependOnTheGroupSizeNorOnTheRun) {
    const Scene& scene = twoThatBreak();
    const World world = adopting::adopt(scene);
    for (const uint32_t size : {8u, 64u, 256u})
        EXPECT_TRUE(sameBytes(adopting::adopt(scene, {.group_size = size, .retire = false}), world)) << size;
}

TEST(SmallAdopt, WhatIsRefusedChangesNothing) {
    Scene scene = twoThatBreak(); // a copy
    const World all = adopting::adopt(scene);
    adopting::refuse(scene, 0);
    const World some = adopting::adopt(scene, {.retire = true});
    EXPECT_EQ(some.adopted, (std::vector<uint32_t>{0, 1}));
    EXPECT_GT(some.bodies[0].offset.w, 0);
    const auto same = [&](const Part& part) {
        const void *is = &some.bodies[part.room.x], *was = &all.bodies[part.room.x];
        return std::memcmp(is, was, sizeof(gpu::BodyState)) == 0;
    };
    EXPECT_TRUE(std::ranges::all_of(scene.parts, [&](const Part& part) { return part.object == 0 || same(part); }));
    adopting::refuse(scene, 1);
    EXPECT_TRUE(sameBytes(adopting::adopt(scene, {.retire = true}), adopting::emptyWorld(scene)));
}

TEST(SmallAdopt, AnEventThatFailedChangesNothing) {
    const Scene& scene = twoThatBreak();
    EXPECT_TRUE(sameBytes(adopting::adopt(scene, {.retire = true, .failed = true}), adopting::emptyWorld(scene)));
}

// Takes away what the rooms of fragments are to hold; the rest must be what it was.
TEST(SmallAdopt, NothingBesideTheRoomsIsWritten) {
    const Scene& scene = twoThatBreak();
    World world = adopting::adopt(scene);
    const World empty = adopting::emptyWorld(scene);
    const auto reset = [](auto& pool, const auto& from, uint32_t first, uint32_t count) {
        std::copy_n(from.begin() + first, count, pool.begin() + first);
    };
    for (const Part& part : scene.parts) {
        const gpu::uvec4 room = part.room;
        const uint32_t faces = scene.objects[part.object].result.fragments.colliders.pieces[part.fragment].face_count;
        reset(world.bodies, empty.bodies, room.x, 1);
        reset(world.shapes, empty.shapes, room.x, 1);
        reset(world.breakable, empty.breakable, room.x, 1);
        reset(world.pieces, empty.pieces, room.y, 1);
        reset(world.hulls, empty.hulls, room.y, 1);
        reset(world.hull_faces, empty.hull_faces, room.z, faces);
        reset(world.hull_vertices, empty.hull_vertices, VERTICES_A_FACE * room.z, VERTICES_A_FACE * faces);
        reset(world.hull_edges, empty.hull_edges, EDGES_A_FACE * room.z, EDGES_A_FACE * faces);
        reset(world.hull_corners, empty.hull_corners, CORNERS_A_FACE * room.z, CORNERS_A_FACE * faces);
        reset(world.vertices, empty.vertices, 3 * room.w, fragmentOf(scene, part).vertex_count);
    }
    EXPECT_TRUE(sameBytes(world, empty));
}

using Words = std::array<uint32_t, 4>;
Words wordsOf(const gpu::uvec4& v) { return {v.x, v.y, v.z, v.w}; }

TEST(SmallAdopt, BodiesThatBrokeLeaveTheWorldAndGiveBackWhatTheyTook) {
    const Scene& scene = twoThatBreak();
    const World world = adopting::adopt(scene, {.retire = true});
    for (uint32_t k = 0; k < 2; k++) {
        EXPECT_EQ(world.bodies[k].offset.w, 0);
        for (const gpu::vec4& v : {world.bodies[k].velocity, world.bodies[k].spin, world.bodies[k].momentum})
            EXPECT_EQ(vec(v), Vector3d(0, 0, 0));
        EXPECT_EQ(world.breakable[k].surface.w, NO_INDEX);
        for (const uint32_t p : {2 * k, 2 * k + 1})
            EXPECT_EQ(world.pieces[p].ids.y, NO_INDEX);
        EXPECT_EQ(wordsOf(world.returned[k].begin), (Words{k, 2 * k, 10 * k, 5 * k}));
        EXPECT_EQ(wordsOf(world.returned[k].size), (Words{1, 2, 10, 5}));
    }
}

} // namespace
