// Fragments that the device makes bodies of are the bodies that the host would make of them, and together they are and move as
// what they were parts of.
#include "modules/brittle/dynamics/piece_shape.h"
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/effects/blow.h"
#include "modules/brittle/mesh/measures.h"
#include "modules/brittle/mesh/primitives.h"
#include "tests/module/adopting.h"
#include "tests/support/solids.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <set>

namespace {

using adopting::Object, adopting::Part, adopting::Scene, adopting::ToBreak, adopting::World;
using brittle::Double3, brittle::Fragment;
using Eigen::Matrix3d, Eigen::Quaterniond, Eigen::Vector3d;

using uint = uint32_t;
#include "shaders-spirv/lib/hash.glsl"

Vector3d vec(const gpu::vec4& v) { return {v.x, v.y, v.z}; }
Vector3d vec(const Double3& v) { return {v[0], v[1], v[2]}; }
Double3 triple(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Quaterniond rotation(const gpu::vec4& q) { return Quaterniond(q.w, q.x, q.y, q.z).normalized(); }
Vector3d placeOf(const gpu::BodyState& s) {
    return double{SECTOR_EDGE} * Vector3d(s.sector.x, s.sector.y, s.sector.z) + vec(s.offset);
}

const Fragment& fragmentOf(const Scene& scene, const Part& part) {
    return scene.objects[part.object].result.fragments.fragments[part.fragment];
}
double wholeMass(const Object& o) { return 1 / double{o.state.offset.w}; }
double densityOf(const Object& o) { return wholeMass(o) / double{o.body.form.x}; }
// From the frame of its vertices to the world.
Quaterniond frameOf(const Object& o) { return rotation(o.state.turn) * rotation(o.body.turn); }
// From the whole's center of mass, world axes, to a place that counts from the middle of its mesh.
Vector3d wayTo(const Object& o, const Double3& p) { return frameOf(o) * (vec(p) + vec(o.center) - vec(o.body.balance)); }

Vector3d momentsOf(const gpu::BodyShape& s) {
    return {1 / double{s.inverse_inertia[0].x}, 1 / double{s.inverse_inertia[1].y}, 1 / double{s.inverse_inertia[2].z}};
}
Matrix3d inertiaOf(const gpu::BodyState& state, const gpu::BodyShape& shape) {
    const Matrix3d axes = rotation(state.turn).toRotationMatrix();
    return axes * momentsOf(shape).asDiagonal() * axes.transpose();
}

// As a scene that begins broken has it.
brittle::BodyDefinition definitionOf(const Scene& scene, const Part& part) {
    const Object& o = scene.objects[part.object];
    const Fragment& f = fragmentOf(scene, part);
    const Vector3d way = wayTo(o, f.centroid), spin = vec(o.state.spin);
    const Quaterniond frame = frameOf(o);
    brittle::BodyDefinition body;
    body.pieces = {pieceOf(o.result.fragments.colliders, o.result.fragments.colliders.pieces[part.fragment], f.centroid)};
    body.place = triple(placeOf(o.state) + way);
    body.turn = {frame.x(), frame.y(), frame.z(), frame.w()};
    body.velocity = triple(vec(o.state.velocity) + spin.cross(way));
    body.spin = triple(spin);
    body.mass = densityOf(o) * f.volume;
    for (size_t k = 0; k < 6; k++)
        body.inertia[k] = densityOf(o) * f.inertia[k];
    body.friction = double{o.shape.inverse_inertia[0].w};
    body.restitution = double{o.shape.inverse_inertia[1].w};
    return body;
}

// One body of the host next to one of the device.
struct Pair {
    const brittle::WorldContents& host;
    uint32_t number;
    const World& world;
    gpu::uvec4 room;
    const Object& whole;

    const gpu::BodyState& wanted() const { return host.bodies[number]; }
    const gpu::BodyState& state() const { return world.bodies[room.x]; }
    const gpu::BodyShape& wantedShape() const { return host.shapes[number]; }
    const gpu::BodyShape& shape() const { return world.shapes[room.x]; }
    const gpu::HullRecord& wantedHull() const { return host.hulls.records[number]; }
    const gpu::HullRecord& hull() const { return world.hulls[room.y]; }
    double reach() const { return double{wantedShape().inverse_inertia[2].w}; }
    const gpu::vec4& vertex(uint32_t v) const { return world.hull_vertices[hull().first.x + v]; }
    const gpu::HullFace& face(uint32_t f) const { return world.hull_faces[hull().first.y + f]; }
    uint32_t corner(const gpu::HullFace& f, uint32_t c) const { return world.hull_corners[f.loop.x + c % f.loop.y]; }
};

void expectMotion(const Pair& p) {
    EXPECT_NEAR(p.state().offset.w, p.wanted().offset.w, 1e-6f * p.wanted().offset.w);
    EXPECT_LE((placeOf(p.state()) - placeOf(p.wanted())).norm(), 1e-6 + 1e-6 * p.reach());
    for (const float x : {p.state().offset.x, p.state().offset.y, p.state().offset.z})
        EXPECT_TRUE(x >= -8 && x < 8);
    // Of what is hundreds of meters wide and spins, the rim is at kilometers a second, of which floats hold 0.5 mm/s.
    const double diagonal = brittle::measureMesh(p.whole.model.prepared.mesh).diagonal, rim = vec(p.wanted().spin).norm() * diagonal;
    EXPECT_LE((vec(p.state().velocity) - vec(p.wanted().velocity)).norm(), std::max(1e-4, 1e-7 * rim));
    EXPECT_EQ(vec(p.state().spin), vec(p.wanted().spin));
    EXPECT_LE((vec(p.state().momentum) - vec(p.wanted().momentum)).norm(), 2e-6 * vec(p.wanted().momentum).norm());
    EXPECT_NEAR(vec(p.state().turn).squaredNorm() + std::pow(double{p.state().turn.w}, 2), 1, 1e-6);
    EXPECT_EQ(p.state().velocity.w, 0);
    EXPECT_EQ(p.state().sector.w & BODY_ASLEEP, 0);
}

void expectInertia(const Pair& p) {
    const Matrix3d is = inertiaOf(p.state(), p.shape()), wanted = inertiaOf(p.wanted(), p.wantedShape());
    EXPECT_LE((is - wanted).norm(), 3e-6 * wanted.norm());
    Vector3d moments = momentsOf(p.shape()), others = momentsOf(p.wantedShape());
    std::ranges::sort(moments);
    std::ranges::sort(others);
    for (int k = 0; k < 3; k++)
        EXPECT_NEAR(moments[k], others[k], 1e-5 * others[k]) << k;
    EXPECT_LE(moments[2], (moments[0] + moments[1]) * (1 + 1e-6));
}

void expectShape(const Pair& p) {
    const gpu::BodyShape &is = p.shape(), &wanted = p.wantedShape();
    EXPECT_EQ(is.pieces.x, p.room.y);
    EXPECT_EQ(is.pieces.y, 1u);
    EXPECT_EQ(is.pieces.w, 0u);
    EXPECT_NEAR(std::bit_cast<float>(is.pieces.z), std::bit_cast<float>(wanted.pieces.z), 1e-5 * p.reach());
    EXPECT_EQ(is.inverse_inertia[0].w, wanted.inverse_inertia[0].w);
    EXPECT_EQ(is.inverse_inertia[1].w, wanted.inverse_inertia[1].w);
    EXPECT_NEAR(is.inverse_inertia[2].w, wanted.inverse_inertia[2].w, 3e-6 * p.reach());
    for (size_t row = 0; row < 3; row++)
        for (size_t k = 0; k < 3; k++)
            EXPECT_TRUE(row == k || (&is.inverse_inertia[row].x)[k] == 0);
    const gpu::uvec4& ids = p.world.pieces[p.room.y].ids;
    EXPECT_EQ((std::array{ids.x, ids.y, ids.z, ids.w}), (std::array{p.room.y, p.room.x, 0u, 0u}));
}

// The same vertices in the same places of the world, and a ball that holds them.
void expectVertices(const Pair& p) {
    ASSERT_EQ(p.hull().count.x, p.wantedHull().count.x);
    EXPECT_EQ(p.hull().first.x, VERTICES_A_FACE * p.room.z);
    const Quaterniond is = rotation(p.state().turn), wanted = rotation(p.wanted().turn);
    for (uint32_t v = 0; v < p.hull().count.x; v++) {
        const Vector3d other = vec(p.host.hulls.vertices[p.wantedHull().first.x + v]), own = vec(p.vertex(v));
        ASSERT_LE((is * own - wanted * other).norm(), 2e-6 * p.reach()) << v;
        EXPECT_LE(own.norm(), double{p.shape().inverse_inertia[2].w});
        EXPECT_LE((own - vec(p.hull().center)).norm(), double{p.hull().center.w});
    }
    EXPECT_LE((is * vec(p.hull().center) - wanted * vec(p.wantedHull().center)).norm(), 2e-6 * p.reach());
    EXPECT_NEAR(p.hull().center.w, p.wantedHull().center.w, 5e-6 * p.reach());
}

// Unit normals that are those of the cut, through the corners, with nothing beyond.
void expectFaces(const Pair& p, const Object& o, const brittle::ColliderPiece& piece) {
    ASSERT_EQ(p.hull().count.y, p.wantedHull().count.y);
    EXPECT_EQ(p.hull().first.y, p.room.z);
    const Quaterniond is = rotation(p.state().turn);
    for (uint32_t f = 0; f < p.hull().count.y; f++) {
        const gpu::HullFace& face = p.face(f);
        const Vector3d normal = vec(face.plane);
        const Vector3d cut = frameOf(o) * vec(brittle::toDouble(o.result.fragments.colliders.faces[piece.first_face + f].normal));
        EXPECT_LE((is * normal - cut).norm(), 2e-6);
        for (uint32_t v = 0; v < p.hull().count.x; v++)
            EXPECT_LE(normal.dot(vec(p.vertex(v))) - double{face.plane.w}, 1e-5 * p.reach());
        for (uint32_t c = 0; c < face.loop.y; c++)
            EXPECT_NEAR(normal.dot(vec(p.vertex(p.corner(face, c)))), double{face.plane.w}, 1e-5 * p.reach());
    }
}

using Edge = std::array<uint32_t, 4>;

std::set<Edge> edgesFrom(const gpu::uvec4* first, uint32_t count) {
    std::set<Edge> edges;
    for (uint32_t e = 0; e < count; e++)
        edges.insert({first[e].x, first[e].y, first[e].z, first[e].w});
    return edges;
}

// Loops are the host's, number by number, and so are edges but for their order.
void expectEdges(const Pair& p) {
    const gpu::HullRecord &is = p.hull(), &wanted = p.wantedHull();
    ASSERT_EQ(is.count.z, wanted.count.z);
    ASSERT_EQ(is.count.w, wanted.count.w);
    EXPECT_EQ(is.first.z, CORNERS_A_FACE * p.room.z);
    EXPECT_EQ(is.first.w, EDGES_A_FACE * p.room.z);
    for (uint32_t c = 0; c < is.count.z; c++)
        EXPECT_EQ(p.world.hull_corners[is.first.z + c], p.host.hulls.corners[wanted.first.z + c]);
    EXPECT_EQ(edgesFrom(&p.world.hull_edges[is.first.w], is.count.w),
              edgesFrom(&p.host.hulls.edges[wanted.first.w], wanted.count.w));
}

// Every side of every face is a side of one edge, on the face that the edge says.
void expectClosed(const Pair& p) {
    std::set<std::array<uint32_t, 3>> sides, of_edges;
    for (uint32_t f = 0; f < p.hull().count.y; f++)
        for (uint32_t c = 0; c < p.face(f).loop.y; c++)
            EXPECT_TRUE(sides.insert({p.corner(p.face(f), c), p.corner(p.face(f), c + 1), f}).second);
    for (uint32_t e = 0; e < p.hull().count.w; e++) {
        const gpu::uvec4& edge = p.world.hull_edges[p.hull().first.w + e];
        of_edges.insert({edge.x, edge.y, edge.z});
        of_edges.insert({edge.y, edge.x, edge.w});
    }
    EXPECT_EQ(sides, of_edges);
    EXPECT_EQ(p.hull().count.x + p.hull().count.y, p.hull().count.w + 2);
}

void expectBodies(const Scene& scene, const World& world) {
    brittle::WorldContents host;
    for (uint32_t k = 0; k < scene.parts.size(); k++) {
        SCOPED_TRACE("part " + std::to_string(k));
        const Part& part = scene.parts[k];
        const auto added = addBody(host, definitionOf(scene, part));
        ASSERT_TRUE(added) << added.error().message;
        const Object& o = scene.objects[part.object];
        const Pair pair = {host, k, world, part.room, o};
        expectMotion(pair);
        expectInertia(pair);
        expectShape(pair);
        expectVertices(pair);
        expectFaces(pair, o, o.result.fragments.colliders.pieces[part.fragment]);
        expectEdges(pair);
        expectClosed(pair);
    }
}

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
    EXPECT_LE((vec(body.balance) - vec(f.centroid)).norm(), 1e-7 * vec(f.centroid).norm());
    // A place of the surface in the world, by the whole and by the fragment.
    const Vector3d corner = vec(positionOf(o.result.fragments.vertices[f.first_vertex]));
    const Vector3d here = placeOf(state) + rotation(state.turn) * (rotation(body.turn) * (corner - vec(body.balance)));
    EXPECT_LE((here - placeOf(o.state) - wayTo(o, triple(corner))).norm(), 1e-6 + 2e-6 * corner.norm());
}

double strengthBy(const Scene& scene, uint32_t number) {
    const Part& part = scene.parts[number];
    const uint32_t draw = mixed(mixed(mixed(part.object) ^ adopting::kSteps) + number * 0x85ebca6bu);
    const auto& material = brittle::builtinMaterials()[scene.objects[part.object].body.surface.w];
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
    expectBodies(scene, world);
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
    for (uint32_t k = 0; k < count * count * count; k++)
        cube.given.push_back({(k % count + 0.5) / count, (k / count % count + 0.5) / count, (k / count / count + 0.5) / count});
    return cube;
}

TEST(SmallAdopt, FragmentsAreTheBodiesThatTheHostWouldMake) {
    std::vector<ToBreak> objects;
    objects.push_back(builtin("ring", 12));
    objects.push_back(builtin("icosphere", 20));
    expectAdopted(adopting::breakTogether(std::move(objects)));
}

TEST(Adopt, SizesFromMillimetersToHundredsOfMeters) {
    std::vector<ToBreak> objects;
    objects.push_back(builtin("icosphere", 40, 1e-3));
    objects.push_back(builtin("icosphere", 40, 0.1));
    objects.push_back(builtin("icosphere", 40, 300));
    const Scene scene = adopting::breakTogether(std::move(objects), 2);
    const World world = adopting::adopt(scene);
    expectBodies(scene, world);
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

Scene twoThatBreak() {
    std::vector<ToBreak> objects;
    objects.push_back(builtin("ring", 8));
    objects.push_back(boxOf({1, 1, 1}, 6));
    return adopting::breakTogether(std::move(objects), 6);
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

// So thin that floats of second moments say nothing of its thickness: it is a solid nevertheless.
TEST(Adopt, NeedlesAskewAreSolids) {
    std::vector<ToBreak> objects;
    objects.push_back(askew({5e-4, 2, 5e-4}, 1));
    objects.push_back(askew({2e-4, 2, 2e-4}, 2));
    objects.push_back(askew({1, 2, 1e-4}, 2));
    const Scene scene = adopting::breakTogether(std::move(objects), 8);
    const World world = adopting::adopt(scene);
    for (const Part& part : scene.parts) {
        SCOPED_TRACE(part.object);
        Vector3d moments = momentsOf(world.shapes[part.room.x]);
        std::ranges::sort(moments);
        const gpu::BodyState& state = world.bodies[part.room.x];
        const double thin = scene.objects[part.object].model.prepared.mesh.positions.size() == 0 ? 0 : 1e-4;
        printf("obj %u moments/m %.3g %.3g %.3g  true thin %g\n", part.object, moments[0]*state.offset.w, moments[1]*state.offset.w, moments[2]*state.offset.w, thin);
        EXPECT_GT(moments[0], 0);
        EXPECT_LE(moments[2], (moments[0] + moments[1]) * (1 + 1e-6));
        EXPECT_TRUE(vec(state.momentum).allFinite());
    }
}

TEST(SmallAdopt, BytesDoNotDependOnTheGroupSizeNorOnTheRun) {
    const Scene scene = twoThatBreak();
    const World world = adopting::adopt(scene);
    for (const uint32_t size : {8u, 64u, 256u})
        EXPECT_TRUE(sameBytes(adopting::adopt(scene, {.group_size = size, .retire = false}), world)) << size;
}

TEST(SmallAdopt, WhatIsRefusedChangesNothing) {
    Scene scene = twoThatBreak();
    const World all = adopting::adopt(scene);
    adopting::refuse(scene, 0);
    const World some = adopting::adopt(scene, {.retire = true});
    EXPECT_EQ(some.adopted, (std::vector<uint32_t>{0, 1}));
    EXPECT_EQ(some.returned_count[0], 1u);
    EXPECT_GT(some.bodies[0].offset.w, 0);
    const auto same = [&](const Part& part) {
        return std::memcmp(&some.bodies[part.room.x], &all.bodies[part.room.x], sizeof(gpu::BodyState)) == 0;
    };
    EXPECT_TRUE(std::ranges::all_of(scene.parts, [&](const Part& part) { return part.object == 0 || same(part); }));
    adopting::refuse(scene, 1);
    EXPECT_TRUE(sameBytes(adopting::adopt(scene, {.retire = true}), adopting::emptyWorld(scene)));
}

TEST(SmallAdopt, AnEventThatFailedChangesNothing) {
    const Scene scene = twoThatBreak();
    EXPECT_TRUE(sameBytes(adopting::adopt(scene, {.retire = true, .failed = true}), adopting::emptyWorld(scene)));
}

// Takes away what the rooms of fragments are to hold; the rest must be what it was.
TEST(SmallAdopt, NothingBesideTheRoomsIsWritten) {
    const Scene scene = twoThatBreak();
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

using Range = std::array<uint32_t, 2>;

TEST(SmallAdopt, BodiesThatBrokeLeaveTheWorldAndGiveBackWhatTheyTook) {
    const Scene scene = twoThatBreak();
    const World world = adopting::adopt(scene, {.retire = true, .ranges_before = 3});
    EXPECT_EQ(world.returned_count[0], 5u);
    for (uint32_t k = 0; k < 2; k++) {
        EXPECT_EQ(world.bodies[k].offset.w, 0);
        for (const gpu::vec4& v : {world.bodies[k].velocity, world.bodies[k].spin, world.bodies[k].momentum})
            EXPECT_EQ(vec(v), Vector3d(0, 0, 0));
        EXPECT_EQ(world.breakable[k].surface.w, NO_INDEX);
        for (const uint32_t p : {2 * k, 2 * k + 1})
            EXPECT_EQ(world.pieces[p].ids.y, NO_INDEX);
        const auto returned = [&](uint32_t pool) { return world.returned[pool * adopting::kRanges + 3 + k]; };
        EXPECT_EQ(returned(ROOM_BODY), (Range{k, 1}));
        EXPECT_EQ(returned(ROOM_PIECE), (Range{2 * k, 2}));
        EXPECT_EQ(returned(ROOM_FACES), (Range{10 * k, 10}));
        EXPECT_EQ(returned(ROOM_TRIANGLES), (Range{5 * k, 5}));
    }
}

TEST(SmallAdopt, ListsOfWhatIsGivenBackDoNotOverflow) {
    const Scene scene = twoThatBreak();
    World world = adopting::adopt(scene, {.retire = true, .ranges_before = adopting::kRanges - 1});
    EXPECT_EQ(world.returned_count[0], adopting::kRanges + 1);
    EXPECT_EQ(world.returned[adopting::kRanges - 1], (Range{0, 1}));
    EXPECT_EQ(world.returned[adopting::kRanges], (Range{0xcdcdcdcd, 0xcdcdcdcd}));
}

TEST(LongTmp, Time) {
    for (const uint32_t n : {1u, 10u, 100u, 1000u}) {
        const Scene scene = adopting::breakTogether({builtin("icosphere", n)}, 9);
        double best = 1e9;
        for (int k = 0; k < 5; k++) best = std::min(best, adopting::adopt(scene, {.retire = true, .ranges_before = k == 4 ? 77u : 0u}).ms);
        const World world = adopting::adopt(scene);
        size_t v = 0, fc = 0, c = 0;
        double bulge = 0, off = 0;
        for (const Part& p : scene.parts) {
            v += fragmentOf(scene, p).vertex_count;
            const auto& h = world.hulls[p.room.y];
            fc += h.count.y; c += h.count.z;
            for (uint32_t f = 0; f < h.count.y; f++) {
                const auto& face = world.hull_faces[h.first.y + f];
                for (uint32_t k = 0; k < h.count.x; k++)
                    bulge = std::max(bulge, (vec(face.plane).dot(vec(world.hull_vertices[h.first.x + k])) - face.plane.w) / world.shapes[p.room.x].inverse_inertia[2].w);
                for (uint32_t k = 0; k < face.loop.y; k++)
                    off = std::max(off, std::abs(vec(face.plane).dot(vec(world.hull_vertices[h.first.x + world.hull_corners[face.loop.x + k]])) - face.plane.w) / world.shapes[p.room.x].inverse_inertia[2].w);
            }
        }
        printf("%u sites %zu fragments: %.3f ms, %.2f us a fragment; vertices %zu faces %zu corners %zu bulge %.2g off %.2g\n", n, scene.parts.size(), best, 1e3 * best / scene.parts.size(), v, fc, c, bulge, off);
        const Sums s = sumsOf(scene, world, 0);
        const Object& o = scene.objects[0];
        const Vector3d v0 = vec(o.state.velocity), spin = vec(o.state.spin), turning = wholeInertia(o) * spin;
        const double mass = wholeMass(o), energy = mass * v0.squaredNorm() / 2 + spin.dot(turning) / 2;
        printf("mass %.2g balance %.2g momentum %.2g turning %.2g energy %.2g\n", s.mass / mass - 1, (s.balance / mass).norm(), (s.momentum - mass * v0).norm() / (mass * v0.norm()), (s.turning - turning).norm() / turning.norm(), s.energy / energy - 1);
    }
}

} // namespace
