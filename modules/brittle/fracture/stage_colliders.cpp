// Colliders: fragments measured in fixed directions and along their own surface, islands of a cell parted, and each fragment's
// box cut by all of that and by its cell.
#include "modules/brittle/fracture/event.h"
#include "shaders-spirv/shared/collider.h"

#include <string>

namespace brittle {
namespace {

// Units of height in a model unit.
float fineOf(const Event& e) { return e.grid.scale * static_cast<float>(1 << HEIGHT_BITS); }

// As many colliders as fragments, if there is room.
void recordCount(const Event& e) { e.record.publishSum(COUNT_COLLIDERS, e.capacity.colliders, {{COUNT_FRAGMENTS, 1}}); }

void recordMeasures(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    r.run("list_fragments", Length::counted(COUNT_COMPONENTS), engine::NoPush{},
          {r.counts(), b.demand_offsets, b.records, b.fragment_list, b.island_cells, b.islands});
    r.runGroups("measure_supports_" + std::to_string(e.capacity.collider_directions), r.groupsOf(COUNT_COLLIDERS), fineOf(e),
                {r.counts(), b.fragment_list, b.component_start, b.values, b.pieces, b.positions, b.supports});
    r.runGroups("take_surfaces", r.groupsOf(COUNT_COLLIDERS), fineOf(e),
                {r.counts(), b.fragment_list, b.component_start, b.values, b.pieces, b.sources, b.positions, b.mesh_triangles,
                 b.mesh_positions, b.supports, b.other_keys, b.surfaces});
}

// Pairs of fragments of one cell, and of these the ones whose boxes are not apart.
void recordIslandPairs(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    recordSort(e, COUNT_COLLIDERS, {b.island_cells, b.other_island_cells}, {b.islands, b.other_islands});
    r.run("count_island_pairs", Length::counted(COUNT_COLLIDERS), engine::NoPush{},
          {r.counts(), b.island_cells, b.pair_counts});
    r.scan(Length::counted(COUNT_COLLIDERS), b.pair_counts, b.sums, b.pair_offsets,
           {{COUNT_ISLAND_PAIRS, NO_INDEX, NO_INDEX, NO_INDEX}, {e.capacity.island_pairs, 0, 0, 0}});
    r.run("flag_island_pairs", Length::counted(COUNT_ISLAND_PAIRS), engine::NoPush{},
          {r.counts(), b.island_cells, b.islands, b.pair_offsets, b.supports, b.island_pairs, b.pair_flags});
    r.scan(Length::counted(COUNT_ISLAND_PAIRS), b.pair_flags, b.sums, b.pair_slots,
           {{COUNT_PARTINGS, NO_INDEX, NO_INDEX, NO_INDEX}, {e.capacity.partings, 0, 0, 0}});
    r.compact(Length::counted(COUNT_ISLAND_PAIRS), b.pair_slots, b.parting_list);
    r.run("bound_partings", Length::counted(COUNT_COLLIDERS), engine::NoPush{},
          {r.counts(), b.island_cells, b.islands, b.pair_offsets, b.pair_slots, b.parting_ranges});
}

void recordPartings(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    struct Push {
        float fine;
        uint32_t pairs;
    } push = {fineOf(e), e.capacity.collider_directions / 2};
    r.runGroups("part_islands", r.groupsOf(COUNT_PARTINGS), push,
                {r.counts(), b.parting_list, b.island_pairs, b.fragment_list, b.component_start, b.values, b.pieces,
                 b.positions, b.supports, b.sites, b.partings, b.parting_ranges});
}

void recordColliderPieces(const Event& e) {
    const auto& b = e.b;
    const Capacities& c = e.capacity;
    Recorder& r = e.record;
    const EventGrid& g = e.grid;
    struct Push {
        Int4 box_low, box_high;
        uint32_t directions;
        float step;
    } push = {{g.box_low[0], g.box_low[1], g.box_low[2], 0},
              {g.box_high[0], g.box_high[1], g.box_high[2], 0},
              c.collider_directions,
              g.step};
    r.runGroups("cut_colliders", r.groupsOf(COUNT_COLLIDERS), push,
                {r.counts(), b.sites, b.cell_offsets, b.neighbors, b.fragment_list, b.supports, b.surfaces, b.parting_ranges,
                 b.partings, b.loose_colliders, b.collider_sizes, b.corners});
    r.scan(Length::counted(COUNT_COLLIDERS), b.collider_sizes, b.sums, b.collider_offsets,
           {{COUNT_COLLIDER_FACES, COUNT_COLLIDER_VERTICES, COUNT_COLLIDER_CORNERS, NO_INDEX},
            {c.collider_faces, c.collider_vertices, c.collider_corners, 0}},
           true);
    r.runGroups("emit_colliders", r.groupsOf(COUNT_COLLIDERS), engine::NoPush{},
                {r.counts(), b.loose_colliders, b.collider_offsets, b.fragment_list, e.colliders.records, e.colliders.faces,
                 e.colliders.vertices, e.colliders.corners});
}

} // namespace

void recordColliders(const Event& e) {
    Recorder& r = e.record;
    recordCount(e);
    r.commands().beginLabel("support_heights");
    recordMeasures(e);
    r.commands().endLabel();
    r.commands().beginLabel("part_islands");
    recordIslandPairs(e);
    if (e.capacity.rare.partings) recordPartings(e);
    r.commands().endLabel();
    r.commands().beginLabel("collider");
    recordColliderPieces(e);
    r.commands().endLabel();
}

} // namespace brittle
