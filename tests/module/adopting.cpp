#include "tests/module/adopting.h"

#include "engine/arena.h"
#include "modules/brittle/breaking/adopt.h"
#include "modules/brittle/effects/material.h"
#include "modules/brittle/fracture/batch.h"
#include "modules/brittle/fracture/fetch.h"
#include "modules/brittle/fracture/upload.h"
#include "modules/brittle/mesh/measures.h"
#include "modules/brittle/mesh/vector_math.h"
#include "shaders-spirv/shared/collider.h"
#include "shaders-spirv/shared/fragment_record.h"
#include "shaders-spirv/shared/solver.h"
#include "tests/engine/test_device.h"

#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>
#include <tuple>

namespace adopting {
namespace {

using brittle::ColliderFaceRecord, brittle::ColliderPiece, brittle::ColliderRecord, brittle::Double3, brittle::Fragment,
    brittle::FragmentRecord, brittle::FragmentSet;
using brittle::operator+, brittle::operator-, brittle::operator*, brittle::cross, brittle::length;
using Random = std::mt19937_64;

float narrow(double x) { return static_cast<float>(x); }
gpu::vec4 packed(const Double3& v, double w = 0) { return {narrow(v[0]), narrow(v[1]), narrow(v[2]), narrow(w)}; }

Double3 anywhere(Random& random, double reach) {
    std::uniform_real_distribution<double> draw(-reach, reach);
    return {draw(random), draw(random), draw(random)};
}

gpu::vec4 anyTurn(Random& random) {
    std::normal_distribution<double> draw;
    const double q[4] = {draw(random), draw(random), draw(random), draw(random)};
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    return {narrow(q[0] / size), narrow(q[1] / size), narrow(q[2] / size), narrow(q[3] / size)};
}

// What it was before it broke. Twice as dense as its material, which only its own mass tells.
void placeBody(Object& o, uint32_t number, Random& random) {
    const brittle::MeshMeasures whole = brittle::measureMesh(o.model.prepared.mesh);
    const gpu::vec4 center = packed(anywhere(random, whole.diagonal));
    o.center = {center.x, center.y, center.z};
    const double mass = 2 * brittle::builtinMaterials()[0].density * whole.volume;
    o.state = {{5 - static_cast<int32_t>(number), -300, 20000, BODY_ASLEEP},
               packed(anywhere(random, 8), 1 / mass),
               anyTurn(random),
               packed(anywhere(random, 30), 3),
               packed(anywhere(random, 20)),
               {9, 9, 9, 0}};
    o.shape = {{2 * number, 2, 0, 0}, {{1, 0, 0, 0.7f}, {0, 1, 0, 0.2f}, {0, 0, 1, 4}}};
    const uint32_t triangles = 3 * 5;
    o.body = {{triangles * number, 6, 9, number % 2},
              {narrow(whole.volume), narrow(whole.area), 1, 0},
              {},
              {},
              packed(o.center + whole.centroid),
              anyTurn(random)};
}

std::vector<Double3> sitesOf(const ToBreak& object) {
    if (!object.given.empty()) return object.given;
    brittle::FractureOptions options;
    options.site_count = object.sites;
    options.only_cells = true;
    auto placed = whole::fracture().shatter(object.model.prepared.mesh, object.model.prepared.topology, options);
    EXPECT_TRUE(placed) << placed.error().message;
    return placed->sites;
}

// Slots in no order, hulls and surfaces with gaps between them.
void giveRooms(Scene& scene, Random& random) {
    const auto objects = static_cast<uint32_t>(scene.objects.size()), count = static_cast<uint32_t>(scene.parts.size());
    std::vector<uint32_t> bodies(count), pieces(count);
    for (uint32_t k = 0; k < count; k++) {
        bodies[k] = objects + k;
        pieces[k] = 2 * objects + k;
    }
    std::ranges::shuffle(bodies, random);
    std::ranges::shuffle(pieces, random);
    uint32_t faces = 10 * objects, triangles = 5 * objects;
    for (uint32_t k = count; k-- > 0;) {
        Part& part = scene.parts[k];
        const FragmentSet& set = scene.objects[part.object].result.fragments;
        part.room = {bodies[k], pieces[k], faces, triangles};
        faces += set.colliders.pieces[part.fragment].face_count + 3;
        triangles += set.fragments[part.fragment].vertex_count / 3 + 2;
    }
    scene.sizes = {objects + count, 2 * objects + count, faces, triangles};
}

FragmentRecord recordOf(const Object& o, const Part& part, uint32_t number, uint32_t first_triangle) {
    const Fragment& f = o.result.fragments.fragments[part.fragment];
    const double u = o.unit, cubic = u * u * u, fifth = cubic * u * u;
    const auto& i = f.inertia;
    double area = 0;
    for (uint32_t k = 0; k < f.vertex_count; k += 3) {
        const auto* v = &o.result.fragments.vertices[f.first_vertex + k];
        area += length(cross(positionOf(v[1]) - positionOf(v[0]), positionOf(v[2]) - positionOf(v[0]))) / 2;
    }
    FragmentRecord r{};
    r.measure[0] = narrow(f.volume / cubic);
    r.measure[1] = narrow(area / (u * u));
    for (size_t k = 0; k < 3; k++) {
        r.balance[k] = narrow(f.centroid[k] / u);
        r.squares[k] = narrow(((i[0] + i[1] + i[2]) / 2 - i[k]) / fifth);
        r.products[k] = narrow(-i[3 + k] / fifth);
        r.low[k] = narrow(f.lower[k] / u);
        r.high[k] = narrow(f.upper[k] / u);
    }
    r.fate[2] = number; // its site has its number
    r.fate[3] = f.earlier_index_count / 3;
    r.range[0] = number;
    r.range[1] = first_triangle;
    r.range[2] = f.outer_index_count / 3;
    r.range[3] = f.inner_index_count / 3;
    return r;
}

} // namespace

std::array<int32_t, 3> siteOf(uint32_t number) { return {12345, 1 + static_cast<int32_t>(number), 77}; }

namespace {

// What an event would have left.
struct Left {
    std::vector<FragmentRecord> fragments;
    std::vector<gpu::ivec4> sites;
    std::vector<brittle::FragmentVertex> vertices;
    std::vector<ColliderRecord> colliders;
    std::vector<ColliderFaceRecord> faces;
    std::vector<gpu::vec4> collider_vertices;
    std::vector<uint32_t> corners;
    std::vector<gpu::BreakingRecord> breaking;
    std::vector<gpu::BrokenBody> broken;
    std::vector<gpu::uvec4> rooms;
};

void addCollider(Left& left, const Object& o, const ColliderPiece& piece) {
    const brittle::ColliderSet& set = o.result.fragments.colliders;
    const auto size = [](const auto& pool) { return static_cast<uint32_t>(pool.size()); };
    left.colliders.push_back({{size(left.faces), piece.face_count, size(left.collider_vertices), piece.vertex_count},
                              {size(left.corners), piece.corner_count, 0, 0}});
    for (uint32_t k = 0; k < piece.face_count; k++) {
        const brittle::ColliderFace& f = set.faces[piece.first_face + k];
        left.faces.push_back({{f.normal[0], f.normal[1], f.normal[2], narrow(double{f.height} / o.unit)},
                              {f.first_corner - piece.first_corner + size(left.corners), f.corner_count, NO_INDEX, 0}});
    }
    for (uint32_t k = 0; k < piece.vertex_count; k++)
        left.collider_vertices.push_back(packed((1 / o.unit) * brittle::toDouble(set.vertices[piece.first_vertex + k])));
    const auto first = set.corners.begin() + piece.first_corner;
    left.corners.insert(left.corners.end(), first, first + piece.corner_count);
}

void addPart(Left& left, const Scene& scene, const Part& part) {
    const Object& o = scene.objects[part.object];
    const FragmentSet& set = o.result.fragments;
    const auto number = static_cast<uint32_t>(left.fragments.size());
    left.fragments.push_back(recordOf(o, part, number, static_cast<uint32_t>(left.vertices.size() / 3)));
    const auto tile = static_cast<int32_t>(part.object);
    const auto site = siteOf(number);
    left.sites.push_back(
        {((tile % TILES_IN_ROW) << TILE_BITS) + site[0], ((tile / TILES_IN_ROW) << TILE_BITS) + site[1], site[2], 0});
    const Fragment& f = set.fragments[part.fragment];
    for (uint32_t k = 0; k < f.vertex_count; k++) {
        brittle::FragmentVertex v = set.vertices[f.first_vertex + k];
        for (float& x : v.position)
            x = narrow(double{x} / o.unit);
        left.vertices.push_back(v);
    }
    addCollider(left, o, set.colliders.pieces[part.fragment]);
    left.rooms.push_back(part.room);
}

Left leftOf(const Scene& scene) {
    Left left;
    for (uint32_t k = 0; k < scene.objects.size(); k++) {
        gpu::BreakingRecord r{};
        r.center = packed(scene.objects[k].center, 1 / scene.objects[k].unit);
        left.breaking.push_back(r);
        gpu::BrokenBody broken{};
        broken.ids = {k, NO_INDEX, 0, 0};
        left.broken.push_back(broken);
    }
    for (const Part& part : scene.parts)
        addPart(left, scene, part);
    return left;
}

template <class T>
std::vector<T> blank(size_t count) {
    std::vector<T> values(count);
    std::memset(values.data(), 0xcd, count * sizeof(T));
    return values;
}

// Where everything lies on the device, with what it is filled with.
class Buffers {
public:
    Buffers() {
        auto made = engine::ScratchArena::create(engine_test::device(), 256 << 20, "adopting");
        EXPECT_TRUE(made);
        arena_.emplace(std::move(*made));
    }
    template <class T>
    engine::BufferView of(const std::vector<T>& values) {
        const engine::BufferView view = arena_->take(std::max<size_t>(values.size() * sizeof(T), 16));
        upload_.add(std::span(values), view);
        return view;
    }
    const brittle::Upload& upload() const { return upload_; }

private:
    std::optional<engine::ScratchArena> arena_;
    brittle::Upload upload_;
};

auto poolsOf(World& w) {
    return std::tie(w.bodies, w.shapes, w.pieces, w.hulls, w.hull_vertices, w.hull_faces, w.hull_corners, w.hull_edges,
                    w.breakable, w.vertices, w.returned, w.adopted);
}

brittle::BrokenParts partsOf(Buffers& b, const Left& left) {
    return {b.of(left.fragments), b.of(left.sites),
            b.of(left.vertices),  {b.of(left.colliders), b.of(left.faces), b.of(left.collider_vertices), b.of(left.corners)},
            b.of(left.breaking),  b.of(left.broken),
            b.of(left.rooms)};
}

void read(World& world, const std::vector<engine::BufferView>& views) {
    std::vector<brittle::Fetch> wanted;
    std::apply(
        [&](auto&... pool) {
            (wanted.push_back({views[wanted.size()], pool.data(), pool.size() * sizeof(pool[0])}), ...);
        },
        poolsOf(world));
    const auto done = brittle::fetch(engine_test::device(), wanted);
    EXPECT_TRUE(done) << done.error().message;
}

std::vector<uint32_t> countsOf(const Scene& scene, bool failed) {
    std::vector<uint32_t> counts(STATUS_WORDS);
    counts[COUNT_FRAGMENTS] = static_cast<uint32_t>(scene.parts.size());
    counts[COUNT_BREAKING] = static_cast<uint32_t>(scene.objects.size());
    counts[STATUS_FAILED] = failed ? 1 : 0;
    return counts;
}

template <class Record>
void onDevice(const brittle::Upload& upload, uint32_t group_size, engine::BufferView counts, engine::BufferView args,
              Record&& record) {
    engine::KernelLibrary kernels(engine_test::device(), shaders::all(), {{FLAT_SIZE_ID, group_size}});
    engine::Commands commands(engine_test::device());
    const auto staging = upload.stage(engine_test::device());
    EXPECT_TRUE(staging && commands.begin());
    upload.copy(commands, *staging);
    brittle::Recorder recorder(commands, kernels, counts, args);
    recorder.publish(COUNT_FRAGMENTS, 1u << 30);
    recorder.publish(COUNT_BREAKING, 1u << 30);
    record(recorder);
    EXPECT_TRUE(recorder.status());
    const auto done = commands.submitAndWait();
    EXPECT_TRUE(done) << done.error().message;
}

std::vector<brittle::FractureResult> broken(std::span<const brittle::BreakingObject> objects) {
    brittle::FractureOptions options;
    options.collider = 26;
    auto results = whole::fracture().shatterTogether(objects, options);
    EXPECT_TRUE(results) << results.error().message;
    return std::move(*results);
}

// In turns.
void listParts(Scene& scene) {
    size_t most = 0;
    for (const Object& o : scene.objects)
        most = std::max(most, o.result.fragments.fragments.size());
    for (uint32_t f = 0; f < most; f++)
        for (uint32_t k = 0; k < scene.objects.size(); k++)
            if (f < scene.objects[k].result.fragments.fragments.size()) scene.parts.push_back({k, f, {}});
}

// Bodies that broke, of two pieces each.
void addWhole(World& w, const Object& o, uint32_t k) {
    w.bodies[k] = o.state;
    w.shapes[k] = o.shape;
    w.breakable[k] = o.body;
    for (uint32_t p : {2 * k, 2 * k + 1})
        w.pieces[p].ids = {p, k, 0, 0};
    w.hulls[2 * k] = {{20 * k, 10 * k, 60 * k, 30 * k}, {4, 4, 12, 6}, {}};
    w.hulls[2 * k + 1] = {{20 * k + 8, 10 * k + 4, 60 * k + 24, 30 * k + 12}, {8, 6, 24, 12}, {}};
}

} // namespace

Scene breakTogether(std::vector<ToBreak> objects, uint64_t seed) {
    Scene scene;
    Random random(seed);
    std::vector<brittle::BreakingObject> breaking;
    breaking.reserve(objects.size());
    for (const ToBreak& object : objects)
        breaking.push_back({object.model.prepared.mesh, object.model.prepared.topology, sitesOf(object)});
    std::vector<brittle::FractureResult> results = broken(breaking);
    const auto batch = brittle::joinObjects(breaking);
    for (uint32_t k = 0; k < objects.size(); k++) {
        Object& o = scene.objects.emplace_back();
        o.result = std::move(results[k]);
        o.model = std::move(objects[k].model);
        o.unit = batch->objects[k].unit;
        placeBody(o, k, random);
    }
    listParts(scene);
    giveRooms(scene, random);
    return scene;
}

void refuse(Scene& scene, uint32_t object) {
    for (Part& part : scene.parts)
        if (part.object == object) part.room.x = NO_INDEX;
}

World emptyWorld(const Scene& scene) {
    World w;
    const gpu::uvec4& n = scene.sizes;
    w.bodies = blank<gpu::BodyState>(n.x);
    w.shapes = blank<gpu::BodyShape>(n.x);
    w.breakable = blank<gpu::BreakableBody>(n.x);
    w.pieces = blank<gpu::PieceRecord>(n.y);
    w.hulls = blank<gpu::HullRecord>(n.y);
    w.hull_faces = blank<gpu::HullFace>(n.z);
    w.hull_vertices = blank<gpu::vec4>(VERTICES_A_FACE * n.z);
    w.hull_edges = blank<gpu::uvec4>(EDGES_A_FACE * n.z);
    w.hull_corners = blank<uint32_t>(CORNERS_A_FACE * n.z);
    w.vertices = blank<brittle::FragmentVertex>(3 * n.w);
    w.adopted = blank<uint32_t>(scene.objects.size());
    w.returned = blank<gpu::PoolShare>(kMostReturned);
    for (uint32_t k = 0; k < scene.objects.size(); k++)
        addWhole(w, scene.objects[k], k);
    return w;
}

World adopt(const Scene& scene, const How& how) {
    World world = emptyWorld(scene);
    const Left left = leftOf(scene);
    const std::vector<uint32_t> counts = countsOf(scene, how.failed), no_args(9 * COUNT_TOTAL);
    const std::vector<uint32_t> steps = {kSteps, 0, 0, 0, 0, 0, 0};
    static_assert(STEPS_WORDS == 7);
    const std::vector<gpu::MaterialCard> cards = {brittle::cardOf(brittle::builtinMaterials()[0]),
                                                  brittle::cardOf(brittle::builtinMaterials()[1])};
    const std::vector<gpu::Birth> births(world.bodies.size());
    Buffers b;
    std::vector<engine::BufferView> v;
    std::apply([&](auto&... pool) { (v.push_back(b.of(pool)), ...); }, poolsOf(world));
    const brittle::BrokenParts parts = partsOf(b, left);
    const brittle::BreakableWorld to = {v[0],        v[1],        v[2],        {v[3], v[4], v[5], v[6], v[7]}, v[8], v[9],
                                        b.of(cards), b.of(steps), b.of(births)};
    const engine::BufferView counted = b.of(counts), args = b.of(no_args);
    onDevice(b.upload(), how.group_size, counted, args, [&](brittle::Recorder& recorder) {
        brittle::recordAdoption(recorder, parts, to, {kSeed, kHold}, v[11]);
        if (how.retire) brittle::recordRetirement(recorder, parts, to, v[11], v[10]);
    });
    read(world, v);
    return world;
}

bool sameBytes(const World& a, const World& b) {
    World x = a, y = b;
    const auto same = [](const auto& p, const auto& q) {
        return p.size() == q.size() && std::memcmp(p.data(), q.data(), p.size() * sizeof(p[0])) == 0;
    };
    x.adopted = y.adopted = {}; // these two are not the world's
    x.returned = y.returned = {};
    return std::apply([&](auto&... p) { return std::apply([&](auto&... q) { return (same(p, q) && ...); }, poolsOf(y)); },
                      poolsOf(x));
}

} // namespace adopting
