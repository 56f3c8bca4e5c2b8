#include "modules/brittle/breaking/break.h"

#include <algorithm>
#include <cmath>

namespace brittle {
namespace {

// Of an object of n cells, in squares and lengths of a cell: the surface of a cube has 6 n^(2/3) of them, that of a plate or a
// rod up to 6 n. Its edges, where triangles are all alike, are 2.3 times the root of triangles times that long, and those of
// fragments, which have slivers, longer. All objects together have no more than one with all of the triangles and cells.
Amounts mostOf(const BreakingRoom& room) {
    const double sites = room.sites;
    return {room.sites,
            room.mesh.vertices,
            room.mesh.edges,
            room.mesh.triangles,
            8 * std::sqrt(room.mesh.triangles * sites),
            6 * sites,
            std::max(5.0, 2 * std::sqrt(static_cast<double>(room.most_sites)))};
}

// A cut through a smooth surface of n triangles has about 2.5 sqrt(n) sides. Faces of more than HUGE_FACE sides need rough
// surfaces of many triangles; worlds without such bodies do not pay for the kernels.
uint32_t vastSidesOf(uint32_t triangles) {
    constexpr uint32_t kFewTriangles = 50'000;
    return triangles < kFewTriangles ? 0 : std::max(2u * HUGE_FACE, static_cast<uint32_t>(16 * std::sqrt(triangles)));
}

// The mesh is the event's; what is only needed to make it shares memory with the stages that come later.
void shareMesh(const EventBuffers& b, GatherBuffers& gather) {
    gather.mesh_positions = b.mesh_positions;
    gather.grid_vertices = b.grid_vertices;
    gather.mesh_triangles = b.mesh_triangles;
    gather.corner_attributes = b.corner_attributes.front();
    gather.triangle_edges = b.triangle_edges;
    gather.mesh_edges = b.mesh_edges;
}

} // namespace

uint32_t usualFragmentTriangles(uint32_t triangles, uint32_t sites) {
    return static_cast<uint32_t>(triangles + 20 * std::sqrt(static_cast<double>(triangles) * sites) + 64.0 * sites);
}

Capacities roomForBreaking(const BreakingRoom& room, uint32_t collider_directions) {
    Capacities c = usualCapacities(mostOf(room));
    c.bins = gridOfTiles(room.mesh.objects, room.most_sites).binCount();
    c.tiled = true;
    c.touching = room.touching;
    // Sites that crowd about a blow as the paper has them asked for it of 9 in 100 cells, narrow rings of 45, others of far
    // fewer.
    c.exact_medium = std::min(c.exact_medium, std::max(64u, room.sites / 2));
    c.exact_large = 0;
    c.vast_sides = vastSidesOf(room.mesh.triangles);
    c.vast_spans = 8 * c.vast_sides;
    // What does not fit stays whole, so there is no need for as many as a broken mesh of any kind may have.
    c.components = c.fragments = 4 * room.sites + 1024;
    c.emitted = std::min(c.pieces, 2 * usualFragmentTriangles(room.mesh.triangles, room.sites));
    c.rare = {.exact_cells = true,
              .medium_cells = true,
              .large_cells = false,
              .huge_faces = true,
              .flaps = true,
              .films = true,
              .cavities = true,
              .partings = true};
    return withColliders(c, collider_directions);
}

BreakingEvent planBreaking(const engine::Device& device, uint32_t group_size, const BreakingRoom& room,
                           uint32_t collider_directions) {
    BreakingEvent event;
    event.room = room;
    event.grid = gridOfTiles(room.mesh.objects, room.most_sites);
    event.capacity = roomForBreaking(room, collider_directions);
    event.capacity.emit_window = emitWindow(device.limits());
    event.capacity.emitted = std::min(event.capacity.emitted, event.capacity.emit_window);
    event.turn_budget = turnBudget(device, group_size, Search::Grid, room.sites);
    return event;
}

void layOutBreaking(engine::ScratchArena& arena, BreakingEvent& event) {
    const auto beside_sites = [&](engine::ScratchArena& rest) { takeGatherScratch(rest, event.room.mesh, event.gather); };
    layOut(arena, event.capacity, {}, event.b, beside_sites);
    shareMesh(event.b, event.gather);
}

void recordBreaking(Recorder& record, const BreakingEvent& event, engine::BufferView breaking, const SurfaceList& surfaces,
                    const ScenePools& scene, const ColliderPools& colliders) {
    const EventBuffers& b = event.b;
    record.runGroups("open_event", 1, event.grid.binCount() / event.grid.tiles, {record.counts(), record.args()});
    record.gate();
    recordGather(record, event.room.mesh, event.gather, breaking, surfaces);
    recordBreakingSites(record, event.gather, breaking, b.raw_sites, b.placed);
    recordFracture({.grid = event.grid,
                    .capacity = event.capacity,
                    .b = b,
                    .scene = scene,
                    .record = record,
                    .turn_budget = event.turn_budget,
                    .colliders = colliders,
                    .caps = event.caps});
    record.runGroups("check_breaking", 1, engine::NoPush{}, {record.counts(), record.args()});
}

} // namespace brittle
