// Cells: cut from the box in fp32, those in doubt again in integers, larger ones with more room, then packed and linked into a
// diagram.
#include "modules/brittle/fracture/event.h"

namespace brittle {
namespace {

struct CutPush {
    Int4 bins, box_low, box_high;
    uint32_t cell_count, size_class, raw_base, next_capacity;
};

struct FastPush {
    Int4 bins, box_low, box_high;
    uint32_t turn_budget;
};

struct EdgesPush {
    Int4 bins, box_low, box_high;
};

CutPush cutPush(const Event& e, uint32_t size_class) {
    const EventGrid& g = e.grid;
    const Capacities& c = e.capacity;
    const uint32_t queue[4] = {0, c.sites, c.sites + c.exact_medium, c.sites + c.exact_medium + c.exact_large};
    const uint32_t raw_medium = c.sites * RAW_WORDS, raw_large = raw_medium + c.exact_medium * kMediumRaw;
    const uint32_t base[3] = {0, raw_medium, raw_large}, next[3] = {c.exact_medium, c.exact_large, 0};
    return {g.bins,
            {g.box_low[0], g.box_low[1], g.box_low[2], static_cast<int32_t>(queue[size_class])},
            {g.box_high[0], g.box_high[1], g.box_high[2], static_cast<int32_t>(queue[size_class + 1])},
            NO_INDEX,
            size_class,
            base[size_class],
            next[size_class]};
}

// The queue of one size class; what it cannot hold is queued for the next, which is recorded once an event has met such cells.
// The first queue is published as it is filled.
void recordExact(const Event& e, std::string_view name, bool recorded, uint32_t size_class, uint32_t capacity) {
    const auto& b = e.b;
    if (!recorded) return;
    if (size_class > 0) e.record.publish(COUNT_EXACT_SMALL + size_class, capacity);
    e.record.runGroups(name, e.record.groupsOf(COUNT_EXACT_SMALL + size_class), cutPush(e, size_class),
                       {e.record.counts(), b.sites, b.bin_start, b.bin_sites, b.queue, b.raw, b.cell_raw, b.store});
}

void recordEdges(const Event& e, const EdgesPush& push) {
    const auto& b = e.b;
    e.record.runGroups("cut_cells_edges", e.record.groupsOf(COUNT_SITES), push,
                       {e.record.counts(), b.sites, b.bin_start, b.bin_sites, b.raw, b.cell_raw, b.queue, e.record.args()});
}

void recordFiltered(const Event& e, const FastPush& push) {
    const auto& b = e.b;
    if (e.cells == CellMapping::Edges) return recordEdges(e, {push.bins, push.box_low, push.box_high});
    const Length sites = Length::counted(COUNT_SITES);
    switch (e.search) {
    case Search::Linear:
        return e.record.run("cut_cells_linear", sites, push,
                            {e.record.counts(), b.bin_sites, b.raw, b.cell_raw, b.queue, e.record.args()});
    case Search::SphereTree:
        return e.record.run(
            "cut_cells_tree", sites, push,
            {e.record.counts(), b.bin_sites, b.raw, b.cell_raw, b.queue, e.record.args(), b.tree, b.leaf_start, b.leaf_sites});
    default:
        return e.record.run("cut_cells", sites, push,
                            {e.record.counts(), b.bin_sites, b.raw, b.cell_raw, b.queue, e.record.args(), b.bin_start});
    }
}

} // namespace

void recordCutting(const Event& e) {
    FastPush fast = {e.grid.bins,
                     {e.grid.box_low[0], e.grid.box_low[1], e.grid.box_low[2], 0},
                     {e.grid.box_high[0], e.grid.box_high[1], e.grid.box_high[2], 0},
                     e.turn_budget};
    recordFiltered(e, fast);
    const Capacities& c = e.capacity;
    recordExact(e, "cut_cells_exact", c.rare.exact_cells, 0, c.sites);
    recordExact(e, "cut_cells_exact_medium", c.rare.medium_cells, 1, c.exact_medium);
    recordExact(e, "cut_cells_exact_large", c.rare.large_cells, 2, c.exact_large);
}

namespace {

void recordPacking(const Event& e) {
    const auto& b = e.b;
    const Capacities& c = e.capacity;
    const Length sites = Length::counted(COUNT_SITES, c.sites);
    e.record.run("count_cells", sites, engine::NoPush{}, {e.record.counts(), b.cell_raw, b.raw, b.cell_counts});
    e.record.scan(sites, b.cell_counts, b.sums, b.cell_offsets,
                  {{COUNT_NEIGHBORS, COUNT_CORNERS, COUNT_VORONOI_VERTICES, COUNT_VORONOI_EDGES},
                   {c.neighbors, c.corners, c.voronoi_vertices, c.voronoi_edges}},
                  true);
    e.record.run("gather_cells", sites, engine::NoPush{},
                 {e.record.counts(), b.cell_raw, b.raw, b.cell_offsets, b.neighbors, b.corners, b.corner_info, b.vertex_sites,
                  b.edge_ends, b.face_cells});
    e.record.run("link_edges", Length::counted(COUNT_VORONOI_EDGES), engine::NoPush{},
                 {e.record.counts(), b.cell_offsets, b.corners, b.corner_info, b.edge_sites, b.edge_ends});
}

} // namespace

void recordCells(const Event& e) {
    e.record.commands().beginLabel("cut_cells");
    recordCutting(e);
    e.record.commands().endLabel();
    e.record.commands().beginLabel("link_cells");
    recordPacking(e);
    e.record.commands().endLabel();
}

} // namespace brittle
