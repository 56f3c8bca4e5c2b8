// What breaks on the device is the mesh that the host would make of it: the same vertices, triangles and edges.
#include "modules/brittle/breaking/gather.h"
#include "modules/brittle/fracture/event_grid.h"
#include "modules/brittle/fracture/fetch.h"
#include "modules/brittle/fracture/upload.h"
#include "tests/engine/test_device.h"
#include "tests/module/breaking_fragments.h"
#include "tests/reference/geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace {

using breaking_test::Breaking, breaking_test::hit;
using brittle::FragmentSet, brittle::PreparedMesh;

// What the device made of all.
struct Gathered {
    std::vector<uint32_t> counts = std::vector<uint32_t>(STATUS_WORDS);
    std::vector<brittle::Float3> positions;
    std::vector<brittle::Int4> grid;
    std::vector<brittle::Index3> triangles, triangle_edges;
    std::vector<std::array<float, 15>> attributes;
    std::vector<std::array<uint32_t, 2>> edges;
    std::vector<brittle::Int3> sites;
    std::vector<uint32_t> placed;
};

template <class T>
brittle::Fetch into(std::vector<T>& values, size_t count, const engine::BufferView& from) {
    values.resize(count);
    return {from, values.data(), count * sizeof(T)};
}

class GatherDevice {
public:
    explicit GatherDevice(const brittle::GatherRoom& room) : room_(room), kernels_(device(), shaders::all()) {}

    Gathered gather(const std::vector<gpu::BreakingRecord>& breaking, const FragmentSet& set) {
        auto arena = engine::ScratchArena::create(device(), 64 << 20, "gather");
        EXPECT_TRUE(arena);
        const auto counts = arena->take(4 * STATUS_WORDS), args = arena->take(36 * COUNT_TOTAL);
        const auto records = arena->take(sizeof(gpu::BreakingRecord) * breaking.size()),
                   pool = arena->take(32 * set.vertices.size());
        const brittle::GatherBuffers b = brittle::layOutGather(*arena, room_);
        EXPECT_TRUE(arena->status());
        Gathered out;
        uint32_t corners = 0, sites = 0;
        for (const auto& record : breaking) {
            corners += record.range.y + record.range.z;
            sites += record.sites.y;
        }
        sites_ = arena->take(12ull * sites);
        placed_ = arena->take(4ull * sites);
        out.counts[COUNT_BREAKING] = static_cast<uint32_t>(breaking.size());
        out.counts[COUNT_SOUP_TRIANGLES] = corners / 3;
        out.counts[COUNT_SOUP_CORNERS] = corners;
        out.counts[COUNT_ASKED_SITES] = sites;
        run(out, breaking, set, records, pool, b, counts, args);
        read(out, b, counts);
        return out;
    }

private:
    static engine::Device& device() { return engine_test::device(); }

    void run(const Gathered& begin, const std::vector<gpu::BreakingRecord>& breaking, const FragmentSet& set,
             const engine::BufferView& records, const engine::BufferView& pool, const brittle::GatherBuffers& b,
             const engine::BufferView& counts, const engine::BufferView& args) {
        brittle::Upload upload;
        upload.add(std::span(begin.counts), counts);
        upload.add(std::span(breaking), records);
        upload.add(std::span(set.vertices), pool);
        const auto staging = upload.stage(device());
        engine::Commands commands(device());
        ASSERT_TRUE(staging && commands.begin());
        upload.copy(commands, *staging);
        brittle::Recorder recorder(commands, kernels_, counts, args);
        recorder.clear({args});
        for (const uint32_t count :
             std::initializer_list<uint32_t>{COUNT_BREAKING, COUNT_SOUP_TRIANGLES, COUNT_SOUP_CORNERS, COUNT_ASKED_SITES})
            recorder.publish(count, 1u << 30);
        brittle::recordGather(recorder, room_, b, records, pool);
        brittle::recordBreakingSites(recorder, b, records, sites_, placed_);
        ASSERT_TRUE(recorder.status()) << recorder.status().error().message;
        const auto done = commands.submitAndWait();
        ASSERT_TRUE(done) << done.error().message;
    }

    void read(Gathered& out, const brittle::GatherBuffers& b, const engine::BufferView& counts) const {
        const brittle::Fetch first[] = {{counts, out.counts.data(), 4 * STATUS_WORDS}};
        ASSERT_TRUE(brittle::fetch(device(), first));
        const auto& n = out.counts;
        if (n[STATUS_FAILED] != 0) return;
        const brittle::Fetch rest[] = {into(out.positions, n[COUNT_MESH_VERTICES], b.mesh_positions),
                                       into(out.grid, n[COUNT_MESH_VERTICES], b.grid_vertices),
                                       into(out.triangles, n[COUNT_MESH_TRIANGLES], b.mesh_triangles),
                                       into(out.triangle_edges, n[COUNT_MESH_TRIANGLES], b.triangle_edges),
                                       into(out.attributes, n[COUNT_MESH_TRIANGLES], b.corner_attributes),
                                       into(out.edges, n[COUNT_MESH_EDGES], b.mesh_edges),
                                       into(out.sites, n[COUNT_ASKED_SITES], sites_),
                                       into(out.placed, n[COUNT_ASKED_SITES], placed_)};
        ASSERT_TRUE(brittle::fetch(device(), rest));
    }

    brittle::GatherRoom room_;
    engine::KernelLibrary kernels_;
    engine::BufferView sites_, placed_;
};

constexpr float kScale = 0.5f;

Breaking scaledFragments(const char* model, uint32_t sites) { return breaking_test::breakingFragments(model, sites, kScale); }

brittle::Float3 scaledPlace(const PreparedMesh& mesh, uint32_t vertex) {
    return breaking_test::scaledPlace(mesh, vertex, kScale);
}

// Triangles of the host, all objects' own ones first, then all others: places of corners and attributes.
void expectTriangles(const Breaking& breaking, const Gathered& out) {
    size_t at = 0;
    for (const bool own : {true, false})
        for (const PreparedMesh& object : breaking.prepared)
            for (size_t t = 0; t < object.mesh.triangles.size(); ++t) {
                if ((t < object.mesh.own_triangles) != own) continue;
                ASSERT_LT(at, out.triangles.size());
                for (size_t k = 0; k < 3; ++k) {
                    ASSERT_EQ(out.positions[out.triangles[at][k]], scaledPlace(object, object.mesh.triangles[t][k]));
                    for (size_t x = 0; x < 3; ++x)
                        ASSERT_EQ(out.attributes[at][5 * k + x], object.mesh.corner_normals[3 * t + k][x]);
                    for (size_t x = 0; x < 2; ++x)
                        ASSERT_EQ(out.attributes[at][5 * k + 3 + x], object.mesh.corner_uvs[3 * t + k][x]);
                }
                ++at;
            }
    EXPECT_EQ(at, out.triangles.size());
}

void expectEdges(const Gathered& out) {
    std::set<std::array<uint32_t, 2>> seen(out.edges.begin(), out.edges.end());
    EXPECT_EQ(seen.size(), out.edges.size()) << "an edge stands there twice";
    for (size_t t = 0; t < out.triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t from = out.triangles[t][k], to = out.triangles[t][(k + 1) % 3];
            const std::array<uint32_t, 2> ends = {std::min(from, to), std::max(from, to)};
            ASSERT_LT(out.triangle_edges[t][k], out.edges.size());
            ASSERT_EQ(out.edges[out.triangle_edges[t][k]], ends);
        }
}

void expectGrid(const Breaking& breaking, const Gathered& out) {
    std::vector<uint32_t> per_tile(breaking.records.size());
    for (size_t v = 0; v < out.grid.size(); ++v) {
        const brittle::Int4& g = out.grid[v];
        const auto tile = static_cast<uint32_t>((g[1] >> TILE_BITS) * TILES_IN_ROW + (g[0] >> TILE_BITS));
        ASSERT_LT(tile, per_tile.size());
        ++per_tile[tile];
        for (size_t k = 0; k < 3; ++k)
            ASSERT_EQ((g[k] & TILE_MASK) - (1 << 23),
                      static_cast<int32_t>(std::nearbyint(double{out.positions[v][k]} * 0x1p23)));
    }
    for (size_t object = 0; object < per_tile.size(); ++object)
        EXPECT_EQ(per_tile[object], breaking.prepared[object].mesh.positions.size()) << object;
}

uint32_t edgesOf(const Breaking& breaking) {
    uint32_t edges = 0;
    for (const PreparedMesh& object : breaking.prepared)
        edges += static_cast<uint32_t>(object.topology.edges.size());
    return edges;
}

void expectAsOnTheHost(const Breaking& breaking) {
    GatherDevice device(brittle::roomFor(static_cast<uint32_t>(breaking.records.size()), breaking.corners / 3));
    const Gathered out = device.gather(breaking.records, breaking.set);
    ASSERT_EQ(out.counts[STATUS_FAILED], 0u);
    EXPECT_EQ(out.edges.size(), edgesOf(breaking));
    expectTriangles(breaking, out);
    expectEdges(out);
    expectGrid(breaking, out);
}

TEST(SmallGather, MakesTheMeshThatTheHostWouldMake) { expectAsOnTheHost(scaledFragments("builtin:ring", 7)); }
TEST(Gather, MakesTheMeshesOfManyAtOnce) { expectAsOnTheHost(scaledFragments("builtin:icosphere", 200)); }

reference::Triangles trianglesOf(const PreparedMesh& object) {
    reference::Triangles triangles;
    for (const brittle::Index3& t : object.mesh.triangles) {
        reference::Triangle& to = triangles.emplace_back();
        for (size_t k = 0; k < 3; ++k) {
            const brittle::Float3 p = scaledPlace(object, t[k]);
            to[k] = {p[0], p[1], p[2]};
        }
    }
    return triangles;
}

reference::Point inUnits(const brittle::Int3& site) {
    const auto unit = [](int32_t x) { return ((x & TILE_MASK) - (1 << 23)) * 0x1p-23; };
    return {unit(site[0]), unit(site[1]), unit(site[2])};
}

TEST(SmallGather, PlacesSitesInsideTheirObjects) {
    Breaking breaking = scaledFragments("builtin:ring", 7);
    hit(breaking, 20, 1 << 18, 5);
    GatherDevice device(brittle::roomFor(7, breaking.corners / 3));
    const Gathered out = device.gather(breaking.records, breaking.set);
    ASSERT_EQ(out.sites.size(), 20 * breaking.records.size());
    std::set<brittle::Int3> seen;
    for (size_t s = 0; s < out.sites.size(); ++s) {
        const size_t object = s / 20;
        EXPECT_EQ(out.placed[s], 1u);
        EXPECT_EQ(static_cast<size_t>((out.sites[s][1] >> TILE_BITS) * TILES_IN_ROW + (out.sites[s][0] >> TILE_BITS)), object);
        EXPECT_GT(reference::windingNumber(trianglesOf(breaking.prepared[object]), inUnits(out.sites[s])), 0.5) << s;
        seen.insert(out.sites[s]);
    }
    EXPECT_EQ(seen.size(), out.sites.size());
    EXPECT_EQ(device.gather(breaking.records, breaking.set).sites, out.sites);
}

// Of a solid every other site has a density that is even up to r0 and falls as r^-4 beyond, in a ball of radius R r0 that is
// hit: of a sphere of radius r about the blow a share of (1 - r / (2 R)) / 2 lies in it. The others lie evenly: of the ball a
// share of (r / R)^3 (1 / 2 - 3 r / (16 R)) is nearer to the blow than r.
TEST(Gather, SitesCrowdAboutTheBlow) {
    Breaking breaking = scaledFragments("builtin:icosphere", 1);
    constexpr uint32_t kSites = 4000;
    constexpr int32_t kRadius = 1 << 18;
    hit(breaking, kSites, kRadius, 11);
    GatherDevice device(brittle::roomFor(1, breaking.corners / 3));
    const Gathered out = device.gather(breaking.records, breaking.set);
    const gpu::ivec4& impact = breaking.records[0].impact;
    double core = 0, near = 0, far = 0;
    for (const brittle::Int3& site : out.sites) {
        const double away = std::hypot(site[0] - impact.x, site[1] - impact.y, site[2] - impact.z) / kRadius;
        (away <= 1 ? core : away <= 2 ? near : far) += 1.0 / kSites;
    }
    const double ball = 0.5 * 0x1p23 / kRadius;
    const double in_core = 1.0 / 3 - 1 / (8 * ball), in_near = 0.5 - std::log(2.0) / (2 * ball),
                 in_far = 0.5 - 1 / (2 * ball) - std::log(ball) / (2 * ball), all = in_core + in_near + in_far;
    const auto evenWithin = [&](double r) { return std::pow(r / ball, 3) * (0.5 - 3 * r / (16 * ball)); };
    EXPECT_NEAR(core, (in_core / all + evenWithin(1)) / 2, 0.03);
    EXPECT_NEAR(near, (in_near / all + evenWithin(2) - evenWithin(1)) / 2, 0.03);
    EXPECT_NEAR(far, (in_far / all + 1 - evenWithin(2)) / 2, 0.03);
}

TEST(SmallGather, OfNothingIsNothing) {
    GatherDevice device(brittle::roomFor(4, 100));
    const Gathered out = device.gather({}, scaledFragments("builtin:ring", 2).set);
    EXPECT_EQ(out.counts[STATUS_FAILED], 0u);
    EXPECT_EQ(out.counts[COUNT_MESH_TRIANGLES], 0u);
}

TEST(SmallGather, SaysWhatItHadNoRoomFor) {
    const Breaking breaking = scaledFragments("builtin:ring", 3);
    brittle::GatherRoom room = brittle::roomFor(3, breaking.corners / 3);
    room.edges = edgesOf(breaking) - 1;
    const Gathered out = GatherDevice(room).gather(breaking.records, breaking.set);
    EXPECT_NE(out.counts[STATUS_FAILED], 0u);
    EXPECT_EQ(out.counts[STATUS_NEEDED + COUNT_MESH_EDGES], edgesOf(breaking));
}

} // namespace
