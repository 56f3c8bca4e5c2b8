// Where the buffers of an event lie in the general buffer. What one stage alone needs shares its memory with what the other
// stages need; stages clear their own tables when they begin.
#include "modules/brittle/fracture/pools.h"
#include "shaders-spirv/shared/collider.h"

#include <algorithm>

namespace brittle {
namespace {

// Words a cell of the two larger exact kernels keeps in its store.
constexpr uint64_t kMediumStore = 8 * 256 + 23 * 512, kLargeStore = 8 * 2048 + 23 * 4096;

class Taker {
public:
    explicit Taker(engine::ScratchArena& arena) : arena_(arena) {}
    engine::BufferView words(uint64_t count) { return take(4 * std::max<uint64_t>(count, 4)); }
    engine::BufferView quads(uint64_t count) { return take(16 * std::max<uint64_t>(count, 1)); }
    uint64_t largest() const { return largest_; }

private:
    engine::BufferView take(uint64_t bytes) {
        largest_ = std::max(largest_, bytes);
        return arena_.take(bytes);
    }
    engine::ScratchArena& arena_;
    uint64_t largest_ = 0;
};

struct Input {
    const Capacities& c;
    const TriangleColumns& columns;
    EventBuffers& b;
};

// What is read until the end: the mesh, sites, places, and what the surface is put together from.
void takeKept(const Input& in, Taker& take) {
    const Capacities& c = in.c;
    EventBuffers& b = in.b;
    uint64_t longest =
        std::max({uint64_t{c.pieces}, uint64_t{c.edges}, uint64_t{c.neighbors}, uint64_t{c.bins}, uint64_t{c.voronoi_edges},
                  uint64_t{c.island_pairs}, uint64_t{VAST_HALVES} * c.vast_sides, uint64_t{c.vast_sides} * 4});
    uint64_t points = c.points();
    b.counts = take.words(STATUS_WORDS);
    b.args = take.words(9ull * COUNT_TOTAL);
    b.sums = take.quads(longest / SCAN_BLOCK + 2);
    b.mesh_positions = take.words(3ull * c.vertices);
    b.mesh_triangles = take.words(3ull * c.triangles);
    b.corner_attributes.clear();
    for (uint32_t part = 0; part < c.sourceParts(); part++)
        b.corner_attributes.push_back(take.words(15ull * c.sourcesIn(part)));
    b.sites = take.quads(c.sites);
    b.positions = take.quads(points);
    b.cell_offsets = take.quads(c.sites + 1ull);
    b.neighbors = take.words(c.neighbors);
    b.face_cells = take.words(c.neighbors);
    b.owners = take.words(c.vertices);
    b.triangle_slot = take.words(c.triangles + 1ull);
    b.polygons = take.quads(c.polygons);
    b.polygon_offsets = take.quads(c.polygons + 1ull);
    b.polygon_corners = take.words(c.sides);
    b.welded = take.words(points);
    b.shared_points = take.words(points);
    b.faces = take.words(c.neighbors);
    b.face_offsets = take.words(c.neighbors + 1ull);
    b.loose_caps = take.words(3 * (uint64_t{c.segments} + c.nodes));
    b.cap_slots = take.words(c.neighbors);
    b.cap_offsets = take.words(c.neighbors + 1ull);
    b.vast_faces = take.quads(c.vastFaces());
    b.vast_ends = take.quads(c.vast_sides);
    b.vast_offsets = take.words(uint64_t{VAST_HALVES} * c.vast_sides + 1);
    b.vast_caps = take.words(3ull * VAST_HALVES * c.vast_sides);
    b.wedges = take.words(c.touching ? 3ull * c.triangles : 0);
    if (c.touching) b.polygon_sides = take.words(c.sides);             // they separate islands
    if (c.collider_directions != 0) b.corners = take.quads(c.corners); // colliders start from them
}

// The diagram, and where mesh and diagram cross: read until the caps are made.
void takeDiagram(const Input& in, Taker& take) {
    const Capacities& c = in.c;
    EventBuffers& b = in.b;
    uint64_t points = c.points();
    b.triangle_edges = take.words(3ull * c.triangles);
    b.mesh_edges = take.words(2ull * c.edges);
    b.grid_vertices = take.quads(c.vertices);
    b.vertex_tiles = take.words(c.tiled ? c.vertices : 0);
    b.bin_start = take.words(c.bins + 1ull);
    b.bin_sites = take.quads(c.sites);
    if (c.collider_directions == 0) b.corners = take.quads(c.corners);
    b.corner_info = take.words(2ull * c.corners);
    b.vertex_sites = take.quads(c.voronoi_vertices);
    b.edge_sites = take.quads(c.voronoi_edges);
    b.edge_ends = take.words(2ull * c.voronoi_edges);
    b.crossings = take.quads(c.crossings);
    if (!c.touching) b.polygon_sides = take.words(c.sides);
    b.triples = take.quads(c.triples);
    b.triple_signs = take.words(c.triples);
    b.points = take.words(6 * points);
    b.edge_triple_offsets = take.words(c.voronoi_edges + 1ull);
    b.ordered_triples = take.words(2ull * c.triples);
    b.links = take.words(2ull * c.voronoi_vertices);
    b.other_links = take.words(2ull * c.voronoi_vertices);
}

void takeSites(const Input& in, Taker& take) {
    const Capacities& c = in.c;
    const TriangleColumns& columns = in.columns;
    EventBuffers& b = in.b;
    b.raw_sites = take.words(3ull * c.sites);
    b.placed = take.words(c.sites);
    b.column_start = take.words(columns.start.size());
    b.column_triangles = take.words(columns.triangles.size());
    b.columns = take.quads(columns.occupied.size());
    b.site_table = take.words(c.siteTable());
    b.site_slots = take.words(c.sites);
    b.welded_sites = take.words(c.sites);
    b.site_flags = take.words(c.sites);
    b.site_offsets = take.words(c.sites + 1ull);
    b.bin_counts = take.words(c.bins);
    b.bin_cursors = take.words(c.bins);
    b.loose_sites = take.words(c.sites);
}

// A closed surface has half as many edges as corners, and fewer vertices than that.
void takeWedges(const Input& in, Taker& take) {
    const Capacities& c = in.c;
    EventBuffers& b = in.b;
    const uint64_t sides = c.touching ? std::max<uint64_t>(3ull * c.triangles, c.vertices) : 0;
    b.place_table = take.words(sides != 0 ? tableSize(sides / 2) : 0);
    b.named_sides = take.words(2 * sides);
    for (engine::BufferView* list :
         {&b.place_slots, &b.place_flags, &b.first_vertices, &b.first_sides, &b.side_heads, &b.side_links, &b.open_wedges})
        *list = take.words(sides);
}

void takeCells(const Input& in, Taker& take) {
    const Capacities& c = in.c;
    EventBuffers& b = in.b;
    uint64_t n = c.sites;
    b.raw = take.words(n * RAW_WORDS + uint64_t{c.exact_medium} * kMediumRaw + uint64_t{c.exact_large} * kLargeRaw);
    b.cell_raw = take.words(2 * n);
    b.queue = take.words(n + c.exact_medium + c.exact_large);
    b.store = take.words(std::max(c.exact_medium * kMediumStore, c.exact_large * kLargeStore));
    b.cell_counts = take.quads(n);
    uint64_t nodes = c.sphere_tree ? n : 0;
    b.tree = take.quads(nodes);
    b.tree_path = take.words(nodes);
    b.tree_bids = take.words(2 * nodes);
    b.leaf_counts = take.words(nodes);
    b.leaf_start = take.words(nodes + 1);
    b.loose_leaves = take.words(nodes);
    b.leaf_sites = take.words(nodes);
}

void takeClipping(const Input& in, Taker& take) {
    const Capacities& c = in.c;
    EventBuffers& b = in.b;
    b.edge_flags = take.words(c.edges);
    b.edge_slot = take.words(c.edges + 1ull);
    b.mixed_edges = take.words(c.edges);
    b.crossing_counts = take.words(c.edges);
    b.crossing_offsets = take.words(c.edges + 1ull);
    b.triangle_flags = take.words(c.triangles);
    b.mixed_triangles = take.words(c.triangles);
    b.pairs = take.words(2ull * c.pairs);
    b.pair_table = take.words(2ull * c.pairTable());
    b.pair_sides = take.words(uint64_t{c.pairs} * c.sides_per_polygon);
    b.pair_shape = take.words(2ull * c.pairs);
    b.round_bounds = take.words(4);
    b.triangle_polygons = take.words(c.triangles);
    b.triangle_polygon_offsets = take.words(c.triangles + 1ull);
    b.triangle_cursors = take.words(c.triangles);
    b.loose_polygons = take.words(c.polygons);
    b.polygon_counts = take.quads(c.polygons);
}

void takePlaces(const Input& in, Taker& take) {
    const Capacities& c = in.c;
    EventBuffers& b = in.b;
    uint64_t points = c.points();
    b.point_table = take.words(c.pointTable());
    b.point_slots = take.words(points);
    b.exact_welded = take.words(points);
}

void takeDepth(const Input& in, Taker& take) {
    const Capacities& c = in.c;
    EventBuffers& b = in.b;
    b.triple_edges = take.words(c.triples);
    b.edge_triple_counts = take.words(c.voronoi_edges);
    b.edge_triple_cursors = take.words(c.voronoi_edges);
    b.edge_sums = take.words(c.voronoi_edges);
    b.loose_triples = take.words(c.triples);
}

void takeCaps(const Input& in, Taker& take) {
    const Capacities& c = in.c;
    EventBuffers& b = in.b;
    b.interval_counts = take.words(c.voronoi_edges);
    b.interval_offsets = take.words(c.voronoi_edges + 1ull);
    b.face_counts = take.words(c.neighbors);
    b.face_cursors = take.words(c.neighbors);
    b.segments = take.quads(c.segments);
    b.face_flags = take.words(c.neighbors);
    b.face_slots = take.words(c.neighbors + 1ull);
    b.wide_faces = take.words(c.neighbors);
    b.large_faces = take.words(c.neighbors);
    b.huge_faces = take.words(c.neighbors);
    b.cap_counts = take.words(c.neighbors);
    b.nodes = take.quads(c.nodes);
    b.rings = take.quads(c.nodes);
    b.loops = take.quads(c.nodes);
    const uint64_t sides = c.vast_sides, halves = VAST_HALVES * sides;
    b.vast_chords = take.quads(sides);
    b.vast_rings = take.quads(sides);
    for (engine::BufferView* list : {&b.vast_keys, &b.vast_values, &b.vast_other_keys, &b.vast_other_values})
        *list = take.words(sides);
    const uint64_t digits = (sides / RADIX_TILE + 1) << RADIX_BITS, tree = sides != 0 ? 2 * c.vastLeaves() : 0;
    b.vast_listed = take.quads(sides);
    b.vast_histogram = take.words(digits);
    b.vast_digit_offsets = take.words(digits + 1);
    b.vast_span_counts = take.words(tree);
    b.vast_span_offsets = take.words(tree + 1);
    b.vast_spans = take.words(c.vast_spans);
    b.vast_diagonals = take.words(4 * sides);
    b.vast_heads = take.words(sides);
    b.vast_links = take.words(halves);
    b.vast_halves = take.words(2 * halves);
    b.vast_marks = take.words(halves);
    b.vast_labels = take.words(2 * halves);
    b.vast_other_labels = take.words(2 * halves);
    b.vast_flags = take.words(halves);
}

// Triangles, islands and fragments: nothing of the diagram is read any more.
void takePieces(const Input& in, Taker& take) {
    const Capacities& c = in.c;
    EventBuffers& b = in.b;
    uint64_t n = c.pieces;
    uint64_t tiles = n / RADIX_TILE + 1;
    b.pieces = take.quads(n);
    b.sources = take.words(n);
    b.parents = take.words(n);
    b.suspects = take.words(c.caps);
    b.flap_table = take.words(4ull * c.flapTable());
    b.flap_slots = take.words(c.rare.flaps ? c.flap_sides : 1);
    b.flap_partners = take.words(c.rare.flaps ? c.flap_sides : 1);
    b.edge_table = take.words(c.edgeTable());
    b.flags = take.quads(n);
    b.flag_offsets = take.quads(n + 1);
    b.keys = take.words(n);
    b.values = take.words(n);
    b.other_keys = take.words(n);
    b.other_values = take.words(n);
    b.histogram = take.words(tiles << RADIX_BITS);
    b.digit_offsets = take.words((tiles << RADIX_BITS) + 1);
    b.components = take.words(n);
    b.component_start = take.words(c.components + 1ull);
    b.records = take.words(32ull * c.components);
    b.fates = take.words(2ull * c.components);
    b.cavities = take.words(c.components);
    b.films = take.words(c.components);
    b.parts = take.words(c.components);
    b.other_parts = take.words(c.components);
    b.classes = take.quads(n);
    b.class_offsets = take.quads(n + 1);
    b.demands = take.quads(c.components);
    b.demand_offsets = take.quads(c.components + 1ull);
    b.shares = take.quads(2ull * c.components);
}

// Read with the pieces, so behind them.
void takeColliders(const Input& in, Taker& take) {
    const Capacities& c = in.c;
    EventBuffers& b = in.b;
    const uint64_t n = c.colliders;
    b.fragment_list = take.words(2 * n);
    for (engine::BufferView* list : {&b.island_cells, &b.other_island_cells, &b.islands, &b.other_islands, &b.pair_counts})
        *list = take.words(n);
    b.supports = take.words(SUPPORT_DIRECTIONS * n);
    b.surfaces = take.words(SURFACE_WORDS * n);
    b.pair_offsets = take.words(n + 1);
    b.island_pairs = take.words(2ull * c.island_pairs);
    b.pair_flags = take.words(c.island_pairs);
    b.pair_slots = take.words(c.island_pairs + 1ull);
    b.parting_list = take.words(c.partings);
    b.parting_ranges = take.words(2 * n);
    b.partings = take.words(uint64_t{PARTING_WORDS} * c.partings);
    b.loose_colliders = take.words(COLLIDER_WORDS * n);
    b.collider_sizes = take.quads(n);
    b.collider_offsets = take.quads(n + 1);
}

} // namespace

uint64_t layOut(engine::ScratchArena& arena, const Capacities& c, const TriangleColumns& columns, EventBuffers& b,
                const TakeMore& beside_sites) {
    const Input in = {c, columns, b};
    Taker take(arena);
    takeKept(in, take);
    const engine::ScratchArena::Mark until_caps = arena.mark();
    takeDiagram(in, take);
    const engine::ScratchArena::Mark one_stage = arena.mark();
    for (const auto stage : {takeSites, takeCells, takeWedges, takeClipping, takePlaces, takeDepth, takeCaps}) {
        stage(in, take);
        if (stage == takeSites && beside_sites) beside_sites(arena);
        if (!c.relaxed || stage != takeSites) arena.release(one_stage);
    }
    arena.release(until_caps);
    takePieces(in, take);
    if (c.collider_directions != 0) takeColliders(in, take);
    return take.largest();
}

} // namespace brittle
