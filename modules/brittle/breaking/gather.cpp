#include "modules/brittle/breaking/gather.h"

#include "modules/brittle/fracture/firsts.h"
#include "modules/brittle/fracture/pools.h"

#include <algorithm>

namespace brittle {
namespace {

void recordVertices(Recorder& record, const GatherRoom& room, const GatherBuffers& b) {
    recordFirsts(record, "weld_corners", COUNT_SOUP_CORNERS, b.corners, {b.table, b.slots, b.firsts, b.flags});
    record.scan(Length::counted(COUNT_SOUP_CORNERS), b.flags, b.sums, b.vertex_numbers,
                {{COUNT_MESH_VERTICES, NO_INDEX, NO_INDEX, NO_INDEX}, {room.vertices, 0, 0, 0}});
}

void recordTriangles(Recorder& record, const GatherRoom& room, const GatherBuffers& b, engine::BufferView breaking,
                     const SurfaceList& surfaces) {
    const Length triangles = Length::counted(COUNT_SOUP_TRIANGLES);
    record.run("flag_solid", triangles, engine::NoPush{}, {record.counts(), breaking, b.firsts, b.triangle_flags});
    record.scan(triangles, b.triangle_flags, b.sums, b.triangle_numbers,
                {{COUNT_OWN_TRIANGLES, COUNT_EARLIER_TRIANGLES, NO_INDEX, NO_INDEX}, {room.triangles, room.triangles, 0, 0}},
                true);
    record.run("write_vertices", Length::counted(COUNT_SOUP_CORNERS), room.triangles,
               {record.counts(), b.corners, b.vertex_numbers, b.mesh_positions, b.grid_vertices, record.args()});
    for (const SurfacePart& part : surfaces.parts()) {
        record.run("write_triangles", triangles, part.range,
                   {record.counts(), breaking, part.vertices, b.firsts, b.vertex_numbers, b.triangle_numbers, b.mesh_triangles,
                    b.corner_attributes, b.sides});
    }
}

void recordEdges(Recorder& record, const GatherRoom& room, const GatherBuffers& b) {
    const Length sides = Length::counted(COUNT_MESH_CORNERS);
    recordFirsts(record, "weld_sides", COUNT_MESH_CORNERS, b.sides, {b.table, b.slots, b.firsts, b.flags});
    record.scan(sides, b.flags, b.sums, b.edge_numbers,
                {{COUNT_MESH_EDGES, NO_INDEX, NO_INDEX, NO_INDEX}, {room.edges, 0, 0, 0}});
    record.run("write_edges", sides, engine::NoPush{},
               {record.counts(), b.sides, b.firsts, b.edge_numbers, b.triangle_edges, b.mesh_edges});
}

} // namespace

GatherRoom roomFor(uint32_t objects, uint32_t triangles) {
    return {objects, triangles, triangles + 4 * objects, triangles + triangles / 2 + triangles / 8 + 6 * objects};
}

void takeGatherScratch(engine::ScratchArena& arena, const GatherRoom& room, GatherBuffers& b) {
    const auto words = [&](uint64_t count) { return arena.take(4 * std::max<uint64_t>(count, 4)); };
    const uint64_t corners = room.corners(), triangles = room.triangles;
    b.corners = words(4 * corners);
    b.table = words(tableSize(room.corners()));
    b.slots = words(corners);
    b.firsts = words(corners);
    b.flags = words(corners);
    b.vertex_numbers = words(corners + 1);
    b.triangle_flags = words(4 * triangles);
    b.triangle_numbers = words(4 * (triangles + 1));
    b.sides = words(2 * corners);
    b.edge_numbers = words(corners + 1);
    b.sums = words(4 * (corners / SCAN_BLOCK + 2));
}

GatherBuffers layOutGather(engine::ScratchArena& arena, const GatherRoom& room) {
    const auto words = [&](uint64_t count) { return arena.take(4 * std::max<uint64_t>(count, 4)); };
    const uint64_t corners = room.corners();
    GatherBuffers b;
    takeGatherScratch(arena, room, b);
    b.mesh_positions = words(3ull * room.vertices);
    b.grid_vertices = words(4ull * room.vertices);
    b.mesh_triangles = words(corners);
    b.corner_attributes = words(5 * corners);
    b.triangle_edges = words(corners);
    b.mesh_edges = words(2ull * room.edges);
    return b;
}

void recordGather(Recorder& record, const GatherRoom& room, const GatherBuffers& b, engine::BufferView breaking,
                  const SurfaceList& surfaces) {
    record.commands().beginLabel("gather");
    for (const SurfacePart& part : surfaces.parts()) {
        record.run("gather_corners", Length::counted(COUNT_SOUP_CORNERS), part.range,
                   {record.counts(), breaking, part.vertices, b.corners});
    }
    recordVertices(record, room, b);
    recordTriangles(record, room, b, breaking, surfaces);
    recordEdges(record, room, b);
    record.commands().endLabel();
}

void recordBreakingSites(Recorder& record, const GatherBuffers& b, engine::BufferView breaking, engine::BufferView raw_sites,
                         engine::BufferView placed) {
    record.runGroups("place_breaking", record.groupsOf(COUNT_ASKED_SITES), engine::NoPush{},
                     {record.counts(), breaking, b.grid_vertices, b.mesh_triangles, b.triangle_numbers, raw_sites, placed});
}

} // namespace brittle
