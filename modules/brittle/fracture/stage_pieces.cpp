// Pieces: surface and caps split into islands, measured, given room in the scene's pools, and written there.
#include "modules/brittle/fracture/event.h"

#include <algorithm>
#include <bit>

namespace brittle {
namespace {

void recordPieces(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    r.run("list_whole", Length::counted(COUNT_MESH_TRIANGLES), engine::NoPush{},
          {r.counts(), b.mesh_triangles, b.owners, b.triangle_slot, b.welded, b.pieces, b.sources, b.parents});
    r.run("list_fans", Length::counted(COUNT_POLYGONS), engine::NoPush{},
          {r.counts(), b.polygons, b.polygon_offsets, b.polygon_corners, b.welded, b.pieces, b.sources, b.parents});
    struct CapPush {
        float unit, step;
    } caps = {e.grid.unit(), EventGrid::kStep};
    r.run("list_caps", Length::counted(COUNT_FACES), caps,
          {r.counts(), b.faces, b.neighbors, b.face_cells, b.face_offsets, b.cap_offsets, b.loose_caps, b.pieces, b.sources,
           b.parents, b.shared_points, b.suspects, b.positions, b.cap_slots});
    if (e.capacity.vast_sides != 0)
        r.run("list_vast_caps", Length::counted(COUNT_VAST_HALVES), caps,
              {r.counts(), b.faces, b.neighbors, b.face_cells, b.vast_faces, b.cap_offsets, b.vast_caps, b.pieces, b.sources,
               b.parents, b.shared_points, b.suspects, b.positions, b.vast_offsets, b.vast_ends});
    r.publishSum(COUNT_TRIANGLES, e.capacity.pieces,
                 {{COUNT_MESH_TRIANGLES, 1}, {COUNT_FAN_TRIANGLES, 1}, {COUNT_CAP_TRIANGLES, 2}});
}

void recordFlaps(const Event& e) {
    const auto& b = e.b;
    const Capacities& c = e.capacity;
    Recorder& r = e.record;
    r.clear({b.flap_table});
    r.publishSum(COUNT_SUSPECT_SIDES, c.flap_sides, {{COUNT_SUSPECTS, 2}});
    r.run("find_flaps", Length::counted(COUNT_SUSPECT_SIDES), c.flapTable() - 1,
          {r.counts(), b.suspects, b.pieces, b.flap_table, b.flap_slots});
    r.run("pair_flaps", Length::counted(COUNT_SUSPECT_SIDES), engine::NoPush{},
          {r.counts(), b.suspects, b.flap_table, b.flap_slots, b.pieces, b.flap_partners});
    r.run("drop_flaps", Length::counted(COUNT_SUSPECT_SIDES), engine::NoPush{},
          {r.counts(), b.suspects, b.flap_partners, b.pieces, b.sources, b.parents});
}

} // namespace

// The number of passes follows from the highest key that the pools admit.
void recordSort(const Event& e, uint32_t count, const engine::BufferView (&keys)[2], const engine::BufferView (&values)[2]) {
    const uint32_t bits = static_cast<uint32_t>(std::bit_width(e.capacity.components));
    e.record.sort(count, bits, keys, values, {e.b.histogram, e.b.digit_offsets, e.b.sums});
}

namespace {

// Triangles of one cell that hang together; `count` of them, or none at all.
void recordUnion(const Event& e, uint32_t count) {
    const auto& b = e.b;
    const Capacities& c = e.capacity;
    Recorder& r = e.record;
    r.clear({b.edge_table});
    uint32_t mask = static_cast<uint32_t>(b.edge_table.size / 4) - 1;
    if (c.touching)
        for (const uint32_t is_second : {0u, 1u})
            r.run("unite_wedges", Length::counted(count), mask,
                  {r.counts(), b.pieces, b.parents, b.edge_table, b.sources, b.wedges, b.polygon_offsets, b.polygon_sides},
                  is_second);
    else
        r.run("unite_triangles", Length::counted(count), mask, {r.counts(), b.pieces, b.parents, b.edge_table});
    r.run("flag_components", Length::counted(count), engine::NoPush{}, {r.counts(), b.pieces, b.parents, b.flags});
    r.scan(Length::counted(count), b.flags, b.sums, b.flag_offsets,
           {{COUNT_VALID, COUNT_COMPONENTS, NO_INDEX, NO_INDEX}, {c.pieces, c.components, 0, 0}}, true);
    r.run("key_triangles", Length::counted(count), engine::NoPush{},
          {r.counts(), b.flag_offsets, b.parents, b.keys, b.values, b.components});
}

void recordFates(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    r.runGroups("mass_properties", r.groupsOf(COUNT_COMPONENTS), e.grid.unit(),
                {r.counts(), b.component_start, b.values, b.pieces, b.sources, b.positions, b.records});
    r.run("decide_fates", Length::counted(COUNT_COMPONENTS), EventGrid::kStep,
          {r.counts(), b.records, b.fates, b.cavities, b.films});
    r.publish(COUNT_CAVITIES, e.capacity.components);
    r.publish(COUNT_FILMS, e.capacity.components);
}

constexpr uint32_t kFilmRounds = 3;

void recordJoining(const Event& e, uint32_t first_round) {
    const auto& b = e.b;
    Recorder& r = e.record;
    for (uint32_t round = first_round; round < first_round + kFilmRounds; round++) {
        struct Push {
            uint32_t round;
            float unit, step;
        } push = {round, e.grid.unit(), EventGrid::kStep};
        r.runGroups("join_films", r.groupsOf(COUNT_FILMS), push,
                    {r.counts(), b.films, b.component_start, b.values, b.pieces, b.sources, b.parents, b.components,
                     b.positions, b.records, b.sites, b.cell_offsets, b.neighbors, b.fates});
    }
}

struct NestPush {
    float unit, step, least;
};

// Films in which there is so much of what a film may hold at most are fragments; in the end the rest is dissolved.
void recordSettling(const Event& e, float least, bool is_last) {
    const auto& b = e.b;
    Recorder& r = e.record;
    if (is_last)
        r.runGroups("nest_films", r.groupsOf(COUNT_FILMS), NestPush{e.grid.unit(), EventGrid::kStep, least},
                    {r.counts(), b.films, b.component_start, b.values, b.pieces, b.positions, b.records, b.fates});
    struct Push {
        float least;
        uint32_t is_last;
        float step;
    } push = {least, is_last ? 1u : 0u, EventGrid::kStep};
    r.run("settle_films", Length::counted(COUNT_FILMS), push, {r.counts(), b.films, b.records, b.fates});
}

// Where films were merged, what is left is united and measured anew; otherwise these kernels have nothing to do.
void recordReunion(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    struct IfPush {
        uint32_t count, source, condition;
    } again = {COUNT_AGAIN, COUNT_TRIANGLES, COUNT_FILMS}, sort = {COUNT_SORT, COUNT_VALID, COUNT_AGAIN};
    r.runGroups("publish_if", 1, again, {r.counts(), r.args()});
    r.run("merge_films", Length::counted(COUNT_AGAIN), engine::NoPush{},
          {r.counts(), b.pieces, b.sources, b.parents, b.components, b.fates, b.records});
    recordUnion(e, COUNT_AGAIN);
    r.runGroups("publish_if", 1, sort, {r.counts(), r.args()});
    recordSort(e, COUNT_SORT, {b.keys, b.other_keys}, {b.values, b.other_values});
    r.run("bound_components", Length::counted(COUNT_SORT), engine::NoPush{}, {r.counts(), b.keys, b.component_start});
    r.runGroups("forget_fates", 1, engine::NoPush{}, {r.counts()});
    recordFates(e);
}

// Films join fragments; then those that are left, where thick enough, are fragments, which the rest may join.
void recordFilms(const Event& e) {
    recordJoining(e, 0);
    recordSettling(e, 1.0f / 16, false);
    recordJoining(e, kFilmRounds);
    recordReunion(e);
    recordSettling(e, 1.0f / 1024, true);
}

// What belongs to another component's fragment, sorted by that.
void recordParts(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    r.run("flag_parts", Length::counted(COUNT_COMPONENTS), engine::NoPush{}, {r.counts(), b.fates, b.flags});
    r.scan(Length::counted(COUNT_COMPONENTS), b.flags, b.sums, b.flag_offsets,
           {{COUNT_PARTS, NO_INDEX, NO_INDEX, NO_INDEX}, {e.capacity.components, 0, 0, 0}});
    r.compact(Length::counted(COUNT_COMPONENTS), b.flag_offsets, b.parts);
    r.run("key_parts", Length::counted(COUNT_PARTS), engine::NoPush{}, {r.counts(), b.parts, b.fates, b.keys});
    recordSort(e, COUNT_PARTS, {b.keys, b.other_keys}, {b.parts, b.other_parts});
}

void recordEmitWindow(const Event& e, uint32_t first, uint32_t part) {
    const auto& b = e.b;
    const Capacities& c = e.capacity;
    struct Push {
        uint32_t first_triangle, triangle_count, first_source, source_count;
    } push = {first, std::min(c.emit_window, c.emitted - first), c.source_window * part, c.sourcesIn(part)};
    constexpr VkDeviceSize kVertexBytes = 3 * sizeof(FragmentVertex), kIndexBytes = 3 * sizeof(uint32_t);
    e.record.run("emit", Length::counted(COUNT_VALID), push,
                 {e.record.counts(), b.values, b.components, b.pieces, b.sources, b.positions, b.class_offsets,
                  b.component_start, b.shares, b.demand_offsets, b.fates, b.mesh_positions, b.mesh_triangles,
                  b.corner_attributes[part], e.scene.vertices.sub(kVertexBytes * first, kVertexBytes * push.triangle_count),
                  e.scene.indices.sub(kIndexBytes * first, kIndexBytes * push.triangle_count)});
}

} // namespace

void recordIslands(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    r.commands().beginLabel("split_islands");
    recordPieces(e);
    if (e.capacity.rare.flaps) recordFlaps(e);
    recordUnion(e, COUNT_TRIANGLES);
    recordSort(e, COUNT_VALID, {b.keys, b.other_keys}, {b.values, b.other_values});
    r.run("bound_components", Length::counted(COUNT_VALID), engine::NoPush{}, {r.counts(), b.keys, b.component_start});
    r.commands().endLabel();
}

void recordMassProperties(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    r.commands().beginLabel("mass_properties");
    recordFates(e);
    const Capacities::Rare& rare = e.capacity.rare;
    if (rare.films) recordFilms(e);
    if (rare.cavities)
        r.runGroups("nest_cavities", r.groupsOf(COUNT_CAVITIES), NestPush{e.grid.unit(), EventGrid::kStep, 0},
                    {r.counts(), b.cavities, b.component_start, b.values, b.pieces, b.positions, b.records, b.fates});
    if (rare.cavities || rare.films) recordParts(e);
    r.commands().endLabel();
}

void recordEmission(const Event& e) {
    const auto& b = e.b;
    const Capacities& c = e.capacity;
    Recorder& r = e.record;
    r.commands().beginLabel("allocate");
    r.run("classify_pieces", Length::counted(COUNT_VALID), engine::NoPush{},
          {r.counts(), b.values, b.sources, b.components, b.fates, b.classes, b.parents});
    r.scan(Length::counted(COUNT_VALID), b.classes, b.sums, b.class_offsets, {}, true);
    r.run("allocate", Length::counted(COUNT_COMPONENTS), engine::NoPush{},
          {r.counts(), b.component_start, b.class_offsets, b.fates, b.demands, b.shares, b.parts, b.keys});
    r.scan(Length::counted(COUNT_COMPONENTS), b.demands, b.sums, b.demand_offsets,
           {{COUNT_FRAGMENTS, COUNT_EMITTED, NO_INDEX, NO_INDEX}, {c.fragments, c.emitted, 0, 0}}, true);
    r.commands().endLabel();
    r.commands().beginLabel("emit");
    for (uint32_t first = 0; first < c.emitted; first += c.emit_window)
        for (uint32_t part = 0; part < c.sourceParts(); part++)
            recordEmitWindow(e, first, part);
    r.run("emit_objects", Length::counted(COUNT_COMPONENTS), 1 / e.grid.unit(),
          {r.counts(), b.records, b.fates, b.demand_offsets, b.shares, e.scene.draw_commands, e.scene.bounds, e.scene.fragments,
           e.scene.matrices, e.scene.objects, b.parts, b.keys});
    r.commands().endLabel();
}

} // namespace brittle
