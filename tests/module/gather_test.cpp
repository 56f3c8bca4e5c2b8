// What breaks on the device is the mesh that the host would make of it: the same vertices, triangles and edges.
#include "modules/brittle/breaking/gather.h"
#include "modules/brittle/fracture/event_grid.h"
#include "modules/brittle/fracture/fetch.h"
#include "modules/brittle/fracture/refracture.h"
#include "modules/brittle/fracture/upload.h"
#include "modules/brittle/mesh/primitives.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/engine/test_device.h"
#include "tests/module/whole_fracture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace {

using brittle::FragmentSet, brittle::PreparedMesh;
using brittle::operator-;

// What the device made of all.
struct Gathered {
    std::vector<uint32_t> counts = std::vector<uint32_t>(STATUS_WORDS);
    std::vector<brittle::Float3> positions;
    std::vector<brittle::Int4> grid;
    std::vector<brittle::Index3> triangles, triangle_edges;
    std::vector<std::array<float, 15>> attributes;
    std::vector<std::array<uint32_t, 2>> edges;
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
        const auto records = arena->take(32 * breaking.size()), pool = arena->take(32 * set.vertices.size());
        const brittle::GatherBuffers b = brittle::layOutGather(*arena, room_);
        EXPECT_TRUE(arena->status());
        Gathered out;
        uint32_t corners = 0;
        for (const auto& record : breaking)
            corners += record.range.y + record.range.z;
        out.counts[COUNT_BREAKING] = static_cast<uint32_t>(breaking.size());
        out.counts[COUNT_SOUP_TRIANGLES] = corners / 3;
        out.counts[COUNT_SOUP_CORNERS] = corners;
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
        for (const uint32_t count : {COUNT_BREAKING, COUNT_SOUP_TRIANGLES, COUNT_SOUP_CORNERS})
            recorder.publish(count, 1u << 30);
        brittle::recordGather(recorder, room_, b, records, pool);
        ASSERT_TRUE(recorder.status()) << recorder.status().error().message;
        const auto done = commands.submitAndWait();
        ASSERT_TRUE(done) << done.error().message;
    }

    static void read(Gathered& out, const brittle::GatherBuffers& b, const engine::BufferView& counts) {
        const brittle::Fetch first[] = {{counts, out.counts.data(), 4 * STATUS_WORDS}};
        ASSERT_TRUE(brittle::fetch(device(), first));
        const auto& n = out.counts;
        if (n[STATUS_FAILED] != 0) return;
        const brittle::Fetch rest[] = {into(out.positions, n[COUNT_MESH_VERTICES], b.mesh_positions),
                                       into(out.grid, n[COUNT_MESH_VERTICES], b.grid_vertices),
                                       into(out.triangles, n[COUNT_MESH_TRIANGLES], b.mesh_triangles),
                                       into(out.triangle_edges, n[COUNT_MESH_TRIANGLES], b.triangle_edges),
                                       into(out.attributes, n[COUNT_MESH_TRIANGLES], b.corner_attributes),
                                       into(out.edges, n[COUNT_MESH_EDGES], b.mesh_edges)};
        ASSERT_TRUE(brittle::fetch(device(), rest));
    }

    brittle::GatherRoom room_;
    engine::KernelLibrary kernels_;
};

constexpr float kScale = 0.5f;

struct Breaking {
    FragmentSet set;
    std::vector<PreparedMesh> prepared; // by the host
    std::vector<gpu::BreakingRecord> records;
    uint32_t corners = 0;
};

// Every fragment of a broken model, about the center that the host takes.
Breaking breakingFragments(const char* name, uint32_t sites) {
    const whole::Model model = whole::modelFrom(name);
    brittle::FractureOptions options;
    options.site_count = sites;
    auto broken = whole::fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
    EXPECT_TRUE(broken) << broken.error().message;
    Breaking b;
    b.set = std::move(broken->fragments);
    for (size_t f = 0; f < b.set.fragments.size(); ++f) {
        auto prepared = brittle::prepareFragment(b.set, f);
        EXPECT_TRUE(prepared) << prepared.error().message;
        const brittle::Fragment& fragment = b.set.fragments[f];
        const brittle::Double3 center = prepared->mesh.center - b.set.center;
        const uint32_t own = fragment.outer_index_count - fragment.earlier_index_count;
        const uint32_t other = fragment.earlier_index_count + fragment.inner_index_count;
        b.records.push_back(
            {{static_cast<float>(center[0]), static_cast<float>(center[1]), static_cast<float>(center[2]), kScale},
             {fragment.first_vertex, own, other, b.corners}});
        b.corners += own + other;
        b.prepared.push_back(std::move(*prepared));
    }
    return b;
}

brittle::Float3 scaledPlace(const PreparedMesh& mesh, uint32_t vertex) {
    brittle::Float3 p = mesh.mesh.positions[vertex];
    for (float& x : p)
        x *= kScale;
    return p;
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

TEST(SmallGather, MakesTheMeshThatTheHostWouldMake) { expectAsOnTheHost(breakingFragments("builtin:ring", 7)); }
TEST(Gather, MakesTheMeshesOfManyAtOnce) { expectAsOnTheHost(breakingFragments("builtin:icosphere", 200)); }

TEST(SmallGather, OfNothingIsNothing) {
    GatherDevice device(brittle::roomFor(4, 100));
    const Gathered out = device.gather({}, breakingFragments("builtin:ring", 2).set);
    EXPECT_EQ(out.counts[STATUS_FAILED], 0u);
    EXPECT_EQ(out.counts[COUNT_MESH_TRIANGLES], 0u);
}

TEST(SmallGather, SaysWhatItHadNoRoomFor) {
    const Breaking breaking = breakingFragments("builtin:ring", 3);
    brittle::GatherRoom room = brittle::roomFor(3, breaking.corners / 3);
    room.edges = edgesOf(breaking) - 1;
    const Gathered out = GatherDevice(room).gather(breaking.records, breaking.set);
    EXPECT_NE(out.counts[STATUS_FAILED], 0u);
    EXPECT_EQ(out.counts[STATUS_NEEDED + COUNT_MESH_EDGES], edgesOf(breaking));
}

} // namespace
