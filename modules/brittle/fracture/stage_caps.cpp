// Places of all vertices, depth of the Voronoi vertices, and the caps that close the cuts.
#include "modules/brittle/fracture/event.h"

namespace brittle {
namespace {

constexpr uint32_t kCount = 0, kFill = 1;
// Each round follows up to eight links: seven rounds reach two million.
constexpr uint32_t kDepthRounds = 7;

// First what is one place exactly, then what is one place in the output: of a class either way one point is left.
void recordWelding(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    struct WeldPush {
        uint32_t length, length_count, table_mask;
    } weld = {0, COUNT_POINTS, static_cast<uint32_t>(b.point_table.size / 4) - 1};
    struct ResolvePush {
        uint32_t length, length_count;
    } resolve = {0, COUNT_POINTS};
    const Length points = Length::counted(COUNT_POINTS);
    r.run("weld_points", points, weld, {r.counts(), b.points, b.point_table, b.point_slots});
    r.run("resolve_points", points, resolve, {r.counts(), b.point_table, b.point_slots, b.exact_welded, b.shared_points});
    r.clear({b.point_table});
    r.run("weld_positions", points, weld, {r.counts(), b.positions, b.point_table, b.point_slots, b.exact_welded});
    r.run("resolve_points", points, resolve, {r.counts(), b.point_table, b.point_slots, b.welded, b.shared_points});
}

} // namespace

void recordPlaces(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    r.commands().beginLabel("place_vertices");
    r.clear({b.point_table, b.shared_points});
    r.publishSum(COUNT_ROUND, NO_INDEX, {{COUNT_MESH_VERTICES, 1}, {COUNT_CROSSINGS, 1}});
    r.run("place_crossings", Length::counted(COUNT_ROUND), engine::NoPush{},
          {r.counts(), b.sites, b.grid_vertices, b.mesh_positions, b.mesh_edges, b.crossings, b.points, b.positions});
    r.run("place_triples", Length::counted(COUNT_TRIPLES), engine::NoPush{},
          {r.counts(), b.sites, b.grid_vertices, b.mesh_positions, b.mesh_triangles, b.triples, b.points, b.positions});
    r.run("place_voronoi", Length::counted(COUNT_VORONOI_VERTICES), e.grid.step,
          {r.counts(), b.sites, b.vertex_sites, b.points, b.positions});
    r.publishSum(COUNT_POINTS, e.capacity.points(),
                 {{COUNT_MESH_VERTICES, 1}, {COUNT_CROSSINGS, 1}, {COUNT_TRIPLES, 1}, {COUNT_VORONOI_VERTICES, 1}});
    recordWelding(e);
    r.commands().endLabel();
}

void recordDepth(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    r.commands().beginLabel("classify_cells");
    r.clear({b.edge_triple_counts, b.edge_triple_cursors, b.edge_sums});
    r.run("assign_triples", Length::counted(COUNT_TRIPLES), engine::NoPush{},
          {r.counts(), b.cell_offsets, b.corners, b.corner_info, b.triples, b.triple_signs, b.triple_edges,
           b.edge_triple_counts, b.edge_sums});
    r.scan(Length::counted(COUNT_VORONOI_EDGES), b.edge_triple_counts, b.sums, b.edge_triple_offsets, {});
    r.run("group_triples", Length::counted(COUNT_TRIPLES), engine::NoPush{},
          {r.counts(), b.triple_edges, b.edge_triple_offsets, b.edge_triple_cursors, b.loose_triples});
    r.run("order_triples", Length::counted(COUNT_TRIPLES), engine::NoPush{},
          {r.counts(), b.sites, b.grid_vertices, b.mesh_triangles, b.triples, b.triple_signs, b.triple_edges,
           b.edge_triple_offsets, b.loose_triples, b.ordered_triples});
    r.run("start_depth", Length::counted(COUNT_VORONOI_VERTICES), engine::NoPush{},
          {r.counts(), b.sites, b.cell_offsets, b.corners, b.corner_info, b.vertex_sites, b.edge_ends, b.edge_sums, b.links});
    for (uint32_t round = 0; round < kDepthRounds; round++) {
        uint32_t is_last = round + 1 == kDepthRounds ? 1 : 0;
        const auto& from = round % 2 == 0 ? b.links : b.other_links;
        const auto& to = round % 2 == 0 ? b.other_links : b.links;
        r.run("jump_depth", Length::counted(COUNT_VORONOI_VERTICES), is_last, {r.counts(), from, to});
    }
    r.commands().endLabel();
}

namespace {

void recordSegments(const Event& e) {
    const auto& b = e.b;
    const Capacities& c = e.capacity;
    Recorder& r = e.record;
    const auto& depths = kDepthRounds % 2 == 0 ? b.links : b.other_links;
    for (uint32_t pass : {kCount, kFill}) {
        const auto& faces = pass == kCount ? b.face_counts : b.face_cursors;
        r.run("cap_intervals", Length::counted(COUNT_VORONOI_EDGES), engine::NoPush{},
              {r.counts(), b.cell_offsets, b.neighbors, b.edge_sites, b.edge_ends, depths, b.edge_triple_offsets,
               b.ordered_triples, b.triple_signs, b.interval_counts, b.interval_offsets, faces, b.face_offsets, b.segments},
              pass);
        r.run("cap_cuts", Length::counted(COUNT_POLYGONS), engine::NoPush{},
              {r.counts(), b.cell_offsets, b.neighbors, b.polygons, b.polygon_offsets, b.polygon_sides, b.polygon_corners,
               faces, b.face_offsets, b.segments},
              pass);
        if (pass == kFill) break;
        r.scan(Length::counted(COUNT_VORONOI_EDGES), b.interval_counts, b.sums, b.interval_offsets,
               {{COUNT_INTERVALS, NO_INDEX, NO_INDEX, NO_INDEX}, {c.intervals, 0, 0, 0}});
        r.scan(Length::counted(COUNT_NEIGHBORS), b.face_counts, b.sums, b.face_offsets,
               {{COUNT_SEGMENTS, NO_INDEX, NO_INDEX, NO_INDEX}, {c.segments, 0, 0, 0}});
    }
}

void recordConvexCaps(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    r.run("cap_faces_convex", Length::counted(COUNT_FACES), engine::NoPush{},
          {r.counts(), b.faces, b.face_offsets, b.segments, b.welded, b.loose_caps, b.cap_counts, b.wide_faces, b.cap_slots});
    r.publish(COUNT_WIDE_FACES, e.capacity.neighbors);
    r.runGroups("cap_fans_convex", r.groupsOf(COUNT_WIDE_FACES), engine::NoPush{},
                {r.counts(), b.faces, b.face_offsets, b.segments, b.welded, b.shared_points, b.loose_caps, b.cap_counts,
                 b.wide_faces, b.cap_slots, b.vast_faces});
}

void recordExactCaps(const Event& e) {
    const auto& b = e.b;
    const Capacities& c = e.capacity;
    Recorder& r = e.record;
    r.run("cap_faces", Length::counted(COUNT_FACES), engine::NoPush{},
          {r.counts(), b.sites, b.faces, b.neighbors, b.face_cells, b.face_offsets, b.segments, b.welded, b.points,
           b.loose_caps, b.cap_counts, b.wide_faces, b.cap_slots});
    r.publish(COUNT_WIDE_FACES, c.neighbors);
    r.runGroups("cap_fans", r.groupsOf(COUNT_WIDE_FACES), engine::NoPush{},
                {r.counts(), b.sites, b.faces, b.neighbors, b.face_cells, b.face_offsets, b.segments, b.welded, b.points,
                 b.loose_caps, b.cap_counts, b.wide_faces, b.large_faces, b.huge_faces, b.cap_slots, b.vast_faces});
    r.publish(COUNT_LARGE_FACES, c.neighbors);
    r.publish(COUNT_HUGE_FACES, c.neighbors);
    r.publish(COUNT_NODES, c.nodes);
    r.runGroups("cap_faces_large", r.groupsOf(COUNT_LARGE_FACES), engine::NoPush{},
                {r.counts(), b.sites, b.faces, b.neighbors, b.face_cells, b.face_offsets, b.segments, b.welded, b.points,
                 b.loose_caps, b.cap_counts, b.large_faces, b.nodes, b.rings, b.loops, b.cap_slots});
    if (c.rare.huge_faces)
        r.runGroups("cap_faces_huge", r.groupsOf(COUNT_HUGE_FACES), engine::NoPush{},
                    {r.counts(), b.sites, b.faces, b.neighbors, b.face_cells, b.face_offsets, b.segments, b.welded, b.points,
                     b.loose_caps, b.cap_counts, b.huge_faces, b.nodes, b.rings, b.loops, b.cap_slots});
}

void recordTriangulation(const Event& e) {
    const auto& b = e.b;
    const Capacities& c = e.capacity;
    Recorder& r = e.record;
    r.run("flag_faces", Length::counted(COUNT_NEIGHBORS), engine::NoPush{}, {r.counts(), b.face_offsets, b.face_flags});
    r.scan(Length::counted(COUNT_NEIGHBORS), b.face_flags, b.sums, b.face_slots,
           {{COUNT_FACES, NO_INDEX, NO_INDEX, NO_INDEX}, {c.neighbors, 0, 0, 0}});
    r.compact(Length::counted(COUNT_NEIGHBORS), b.face_slots, b.faces);
    if (e.caps == Caps::Convex)
        recordConvexCaps(e);
    else
        recordExactCaps(e);
    if (c.vast_sides != 0) recordVastCaps(e);
    r.scan(Length::counted(COUNT_FACES), b.cap_counts, b.sums, b.cap_offsets,
           {{COUNT_CAP_TRIANGLES, NO_INDEX, NO_INDEX, NO_INDEX}, {c.caps, 0, 0, 0}});
}

} // namespace

void recordCaps(const Event& e) {
    e.record.commands().beginLabel("cap_faces");
    e.record.clear({e.b.face_counts, e.b.face_cursors});
    recordSegments(e);
    recordTriangulation(e);
    e.record.commands().endLabel();
}

} // namespace brittle
