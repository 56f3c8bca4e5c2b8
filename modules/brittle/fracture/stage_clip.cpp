// Triangles: owners of their corners, crossings of their edges, and the polygons that mixed ones leave in each cell.
#include "modules/brittle/fracture/event.h"

namespace brittle {
namespace {

constexpr uint32_t kCountRound = 0, kFillRound = 1;

void recordOwners(const Event& e) {
    const auto& b = e.b;
    const EventGrid& g = e.grid;
    struct Push {
        Int4 bins, low;
    } push = {g.bins, withLast(g.box_low, 0)};
    e.record.run(
        "own_vertices", Length::counted(COUNT_MESH_VERTICES), push,
        {e.record.counts(), b.sites, b.bin_start, b.bin_sites, b.cell_offsets, b.neighbors, b.grid_vertices, b.owners});
}

void recordCrossings(const Event& e) {
    const auto& b = e.b;
    const Capacities& c = e.capacity;
    const Length edges = Length::counted(COUNT_MESH_EDGES, c.edges);
    e.record.run("flag_edges", edges, engine::NoPush{}, {e.record.counts(), b.mesh_edges, b.owners, b.edge_flags});
    e.record.scan(edges, b.edge_flags, b.sums, b.edge_slot,
                  {{COUNT_MIXED_EDGES, NO_INDEX, NO_INDEX, NO_INDEX}, {c.edges, 0, 0, 0}});
    e.record.compact(edges, b.edge_slot, b.mixed_edges);
    for (uint32_t pass : {kCountRound, kFillRound}) {
        e.record.run("cross_edges", Length::counted(COUNT_MIXED_EDGES), engine::NoPush{},
                     {e.record.counts(), b.sites, b.cell_offsets, b.neighbors, b.grid_vertices, b.mesh_edges, b.owners,
                      b.mixed_edges, b.crossing_counts, b.crossing_offsets, b.crossings},
                     pass);
        if (pass == kCountRound)
            e.record.scan(Length::counted(COUNT_MIXED_EDGES), b.crossing_counts, b.sums, b.crossing_offsets,
                          {{COUNT_CROSSINGS, NO_INDEX, NO_INDEX, NO_INDEX}, {c.crossings, 0, 0, 0}});
    }
}

void recordMixedTriangles(const Event& e) {
    const auto& b = e.b;
    const Capacities& c = e.capacity;
    const Length triangles = Length::counted(COUNT_MESH_TRIANGLES, c.triangles);
    e.record.run("classify_triangles", triangles, engine::NoPush{},
                 {e.record.counts(), b.mesh_triangles, b.triangle_edges, b.owners, b.edge_slot, b.triangle_flags});
    e.record.scan(triangles, b.triangle_flags, b.sums, b.triangle_slot,
                  {{COUNT_MIXED_TRIANGLES, NO_INDEX, NO_INDEX, NO_INDEX}, {c.triangles, 0, 0, 0}});
    e.record.compact(triangles, b.triangle_slot, b.mixed_triangles);
}

struct PairPush {
    uint32_t capacity, table_mask;
};

void recordPairs(const Event& e) {
    const auto& b = e.b;
    const bool wide = e.capacity.sides_per_polygon > USUAL_SIDES;
    const PairPush seed = {e.capacity.pairs, static_cast<uint32_t>(b.pair_table.size / 8) - 1};
    const struct {
        PairPush pairs;
        uint32_t side_stride;
    } clip = {seed, e.capacity.sides_per_polygon};
    e.record.run("seed_pairs", Length::counted(COUNT_MIXED_TRIANGLES), seed,
                 {e.record.counts(), b.mixed_triangles, b.mesh_triangles, b.triangle_edges, b.owners, b.edge_slot,
                  b.crossing_offsets, b.crossings, b.pairs, b.pair_table});
    for (uint32_t round = 0; round <= e.capacity.clip_rounds; round++) {
        struct RoundPush {
            uint32_t capacity, is_last;
        } next = {e.capacity.pairs, round == e.capacity.clip_rounds ? 1u : 0u};
        e.record.runGroups("next_round", 1, next, {e.record.counts(), e.record.args(), b.round_bounds});
        if (next.is_last != 0) break;
        e.record.run(wide ? "clip_triangles_wide" : "clip_triangles", Length::counted(COUNT_ROUND), clip,
                     {e.record.counts(), b.sites, b.cell_offsets, b.neighbors, b.grid_vertices, b.mesh_triangles,
                      b.mixed_triangles, b.round_bounds, b.pairs, b.pair_table, b.pair_sides, b.pair_shape,
                      b.triangle_polygons});
    }
}

void recordPolygons(const Event& e) {
    const auto& b = e.b;
    const Capacities& c = e.capacity;
    e.record.scan(Length::counted(COUNT_MIXED_TRIANGLES), b.triangle_polygons, b.sums, b.triangle_polygon_offsets,
                  {{COUNT_POLYGONS, NO_INDEX, NO_INDEX, NO_INDEX}, {c.polygons, 0, 0, 0}});
    e.record.run("place_polygons", Length::counted(COUNT_PAIRS), engine::NoPush{},
                 {e.record.counts(), b.pairs, b.pair_shape, b.triangle_polygon_offsets, b.triangle_cursors, b.loose_polygons});
    e.record.run("order_polygons", Length::counted(COUNT_POLYGONS), c.sides_per_polygon,
                 {e.record.counts(), b.pairs, b.pair_shape, b.pair_sides, b.triangle_polygon_offsets, b.loose_polygons,
                  b.mixed_triangles, b.polygons, b.polygon_counts});
    e.record.scan(Length::counted(COUNT_POLYGONS), b.polygon_counts, b.sums, b.polygon_offsets,
                  {{COUNT_SIDES, COUNT_TRIPLES, NO_INDEX, COUNT_FAN_TRIANGLES}, {c.sides, c.triples, NO_INDEX, c.fans}}, true);
    e.record.run("list_triples", Length::counted(COUNT_POLYGONS), c.sides_per_polygon,
                 {e.record.counts(), b.polygons, b.polygon_offsets, b.pair_sides, b.polygon_sides, b.triples, b.triple_signs});
    e.record.run("number_corners", Length::counted(COUNT_POLYGONS), engine::NoPush{},
                 {e.record.counts(), b.polygons, b.polygon_offsets, b.polygon_sides, b.mesh_triangles, b.triangle_edges,
                  b.edge_slot, b.crossing_offsets, b.crossings, b.triangle_slot, b.triangle_polygon_offsets, b.triples,
                  b.polygon_corners});
}

} // namespace

void recordClassification(const Event& e) {
    e.record.commands().beginLabel("classify_triangles");
    e.record.clear({e.b.pair_table, e.b.round_bounds, e.b.triangle_polygons, e.b.triangle_cursors});
    recordOwners(e);
    recordCrossings(e);
    recordMixedTriangles(e);
    e.record.commands().endLabel();
}

void recordClipping(const Event& e) {
    e.record.commands().beginLabel("clip_triangles");
    recordPairs(e);
    recordPolygons(e);
    e.record.commands().endLabel();
}

} // namespace brittle
