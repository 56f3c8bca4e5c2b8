#include "modules/brittle/fracture/pools.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace brittle {
namespace {

uint32_t tableSize(uint64_t entries) {
    return static_cast<uint32_t>(std::bit_ceil(std::max<uint64_t>(2 * entries, 64)));
}

struct Extents {
    double edge_length = 0, longest_edge = 0, area = 0, cell = 1;
};

// Lengths in grid steps: a cell's usual size, and how much surface and edge there is to be cut.
Extents measureExtents(const Mesh& mesh, const MeshTopology& topology, const EventGrid& grid, uint32_t site_count) {
    Extents x;
    auto difference = [&](uint32_t a, uint32_t b) {
        Double3 d;
        for (size_t k = 0; k < 3; k++) d[k] = (static_cast<double>(mesh.positions[b][k]) - mesh.positions[a][k]) * grid.scale;
        return d;
    };
    for (const auto& e : topology.edges) {
        Double3 d = difference(e[0], e[1]);
        double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        x.edge_length += length;
        x.longest_edge = std::max(x.longest_edge, length);
    }
    for (const Index3& t : mesh.triangles) {
        Double3 u = difference(t[0], t[1]), w = difference(t[0], t[2]);
        Double3 n = {u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]};
        x.area += 0.5 * std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    }
    double volume = 1;
    for (size_t k = 0; k < 3; k++) volume *= grid.mesh_high[k] - grid.mesh_low[k] + 1.0;
    x.cell = std::cbrt(volume / site_count);
    return x;
}

} // namespace

uint32_t Capacities::pointTable() const { return tableSize(points()); }
uint32_t Capacities::edgeTable() const { return tableSize(uint64_t{3} * pieces / 2); }

Capacities estimateCapacities(const Mesh& mesh, const MeshTopology& topology, const EventGrid& grid, uint32_t site_count) {
    Extents x = measureExtents(mesh, topology, grid, site_count);
    auto size = [](double n) { return static_cast<uint32_t>(std::min(n, 2e8)); };
    double n = site_count, cuts = x.edge_length / x.cell, patches = x.area / (x.cell * x.cell);
    if (site_count == 1) cuts = patches = 0;
    Capacities c;
    c.sites = site_count;
    c.vertices = static_cast<uint32_t>(mesh.positions.size());
    c.edges = static_cast<uint32_t>(topology.edges.size());
    c.triangles = static_cast<uint32_t>(mesh.triangles.size());
    c.bins = grid.binCount();
    c.neighbors = size(20 * n + 2048);
    c.corners = size(34 * n + 4096);
    c.voronoi_vertices = size(9 * n + 1024);
    c.voronoi_edges = size(14 * n + 2048);
    c.crossings = size(2.5 * cuts + 0.02 * c.edges + 2048);
    c.pairs = size(2.5 * c.crossings + 4 * patches + 4096);
    c.polygons = c.pairs;
    c.sides = size(4.5 * c.polygons);
    c.triples = size(0.6 * c.pairs + 3 * patches + 1024);
    c.fans = size(2.5 * c.polygons);
    c.intervals = size(c.voronoi_edges + c.triples * 0.6);
    c.segments = size(3.0 * c.intervals + 1.2 * c.crossings + 1.5 * c.triples);
    c.caps = size(0.62 * c.segments + 1024);
    c.exact_cells = site_count > 256;
    c.pieces = c.triangles + c.fans + 2 * c.caps;
    c.components = size(std::min<double>(c.pieces, 6 * n + 0.1 * c.triangles + 16384));
    c.fragments = c.components;
    c.emitted = c.pieces;
    c.exact_medium = size(std::min(n, 512.0));
    c.exact_large = size(std::min(n, 8.0));
    // A round reaches one cell further in from the triangle's edges.
    c.clip_rounds = 3 + size(std::min(64.0, x.longest_edge / x.cell));
    return c;
}

namespace {

bool takeUp(bool& recorded, bool met) {
    bool news = met && !recorded;
    recorded = recorded || met;
    return news;
}

} // namespace

bool Capacities::grow(const uint32_t* status) {
    const uint32_t* needed = status + STATUS_NEEDED;
    bool more = takeUp(exact_cells, status[COUNT_EXACT_SMALL] != 0);
    more |= takeUp(medium_cells, status[COUNT_EXACT_MEDIUM] != 0);
    more |= takeUp(large_cells, status[COUNT_EXACT_MEDIUM] != 0); // who needs the one often needs the other
    more |= takeUp(huge_faces, status[COUNT_HUGE_FACES] != 0);
    more |= takeUp(cavities, status[COUNT_CAVITIES] != 0);
    if (status[STATUS_ROUNDS_LEFT] != 0) {
        clip_rounds = clip_rounds * 2 + 8;
        more = true;
    }
    if ((status[STATUS_FAILED] & FAILED_CAPACITY) == 0) return more;
    auto fit = [&](uint32_t& pool, uint32_t count) {
        if (needed[count] > pool) pool = needed[count] + needed[count] / 4;
    };
    fit(neighbors, COUNT_NEIGHBORS);
    fit(corners, COUNT_CORNERS);
    fit(voronoi_vertices, COUNT_VORONOI_VERTICES);
    fit(voronoi_edges, COUNT_VORONOI_EDGES);
    fit(crossings, COUNT_CROSSINGS);
    fit(pairs, COUNT_PAIRS);
    fit(polygons, COUNT_POLYGONS);
    fit(sides, COUNT_SIDES);
    fit(triples, COUNT_TRIPLES);
    fit(fans, COUNT_FAN_TRIANGLES);
    fit(intervals, COUNT_INTERVALS);
    fit(segments, COUNT_SEGMENTS);
    fit(caps, COUNT_CAP_TRIANGLES);
    fit(components, COUNT_COMPONENTS);
    fit(exact_medium, COUNT_EXACT_MEDIUM);
    fit(exact_large, COUNT_EXACT_LARGE);
    polygons = std::max(polygons, pairs);
    pieces = triangles + fans + 2 * caps;
    fragments = components;
    emitted = pieces;
    return true;
}

namespace {

// Words a cell of the two larger exact kernels keeps in `raw`, and in its store.
constexpr uint64_t kMediumRaw = 2 + 256 + 2 * 512, kLargeRaw = 2 + 2048 + 2 * 4096;
constexpr uint64_t kMediumStore = 8 * 256 + 23 * 512, kLargeStore = 8 * 2048 + 23 * 4096;

class Taker {
public:
    explicit Taker(engine::ScratchArena& arena) : arena_(arena) {}
    engine::BufferView words(uint64_t count) { return arena_.take(4 * std::max<uint64_t>(count, 4)); }
    engine::BufferView quads(uint64_t count) { return arena_.take(16 * std::max<uint64_t>(count, 1)); }

private:
    engine::ScratchArena& arena_;
};

void layOutSites(Taker& take, const Capacities& c, const TriangleColumns& columns, EventBuffers& b) {
    b.raw_sites = take.words(3ull * c.sites);
    b.placed = take.words(c.sites);
    b.column_start = take.words(columns.start.size());
    b.column_triangles = take.words(columns.triangles.size());
    b.columns = take.quads(columns.occupied.size());
    b.site_table = take.words(tableSize(c.sites));
    b.site_slots = take.words(c.sites);
    b.welded_sites = take.words(c.sites);
    b.site_flags = take.words(c.sites);
    b.site_offsets = take.words(c.sites + 1ull);
    b.sites = take.quads(c.sites);
    b.bin_counts = take.words(c.bins);
    b.bin_start = take.words(c.bins + 1ull);
    b.bin_cursors = take.words(c.bins);
    b.loose_sites = take.words(c.sites);
    b.bin_sites = take.quads(c.sites);
}

void layOutCells(Taker& take, const Capacities& c, EventBuffers& b) {
    uint64_t n = c.sites;
    b.raw = take.words(n * RAW_WORDS + c.exact_medium * kMediumRaw + c.exact_large * kLargeRaw);
    b.cell_raw = take.words(2 * n);
    b.queue = take.words(n + c.exact_medium + c.exact_large);
    b.store = take.words(std::max(c.exact_medium * kMediumStore, c.exact_large * kLargeStore));
    b.cell_counts = take.quads(n);
    b.cell_offsets = take.quads(n + 1);
    b.neighbors = take.words(c.neighbors);
    b.face_cells = take.words(c.neighbors);
    b.corners = take.quads(c.corners);
    b.corner_info = take.words(2ull * c.corners);
    b.vertex_sites = take.quads(c.voronoi_vertices);
    b.edge_sites = take.quads(c.voronoi_edges);
    b.edge_ends = take.words(2ull * c.voronoi_edges);
}

void layOutClip(Taker& take, const Capacities& c, EventBuffers& b) {
    b.owners = take.words(c.vertices);
    b.edge_flags = take.words(c.edges);
    b.edge_slot = take.words(c.edges + 1ull);
    b.mixed_edges = take.words(c.edges);
    b.crossing_counts = take.words(c.edges);
    b.crossing_offsets = take.words(c.edges + 1ull);
    b.crossings = take.quads(c.crossings);
    b.triangle_flags = take.words(c.triangles);
    b.triangle_slot = take.words(c.triangles + 1ull);
    b.mixed_triangles = take.words(c.triangles);
    b.pairs = take.words(2ull * c.pairs);
    b.pair_table = take.words(2ull * tableSize(c.pairs));
    b.pair_sides = take.words(static_cast<uint64_t>(c.pairs) * MAX_SIDES);
    b.pair_shape = take.words(2ull * c.pairs);
    b.round_bounds = take.words(4);
    b.triangle_polygons = take.words(c.triangles);
    b.triangle_polygon_offsets = take.words(c.triangles + 1ull);
    b.triangle_cursors = take.words(c.triangles);
    b.loose_polygons = take.words(c.polygons);
    b.polygons = take.quads(c.polygons);
    b.polygon_counts = take.quads(c.polygons);
    b.polygon_offsets = take.quads(c.polygons + 1ull);
    b.polygon_sides = take.words(c.sides);
    b.polygon_corners = take.words(c.sides);
    b.triples = take.quads(c.triples);
    b.triple_signs = take.words(c.triples);
    uint64_t points = c.points();
    b.points = take.words(6 * points);
    b.positions = take.quads(points);
    b.point_table = take.words(c.pointTable());
    b.point_slots = take.words(points);
    b.welded = take.words(points);
}

void layOutCaps(Taker& take, const Capacities& c, EventBuffers& b) {
    b.triple_edges = take.words(c.triples);
    b.edge_triple_counts = take.words(c.voronoi_edges);
    b.edge_triple_offsets = take.words(c.voronoi_edges + 1ull);
    b.edge_triple_cursors = take.words(c.voronoi_edges);
    b.edge_sums = take.words(c.voronoi_edges);
    b.loose_triples = take.words(c.triples);
    b.ordered_triples = take.words(2ull * c.triples);
    b.links = take.words(2ull * c.voronoi_vertices);
    b.other_links = take.words(2ull * c.voronoi_vertices);
    b.interval_counts = take.words(c.voronoi_edges);
    b.interval_offsets = take.words(c.voronoi_edges + 1ull);
    b.face_counts = take.words(c.neighbors);
    b.face_offsets = take.words(c.neighbors + 1ull);
    b.face_cursors = take.words(c.neighbors);
    b.segments = take.quads(c.segments);
    b.face_flags = take.words(c.neighbors);
    b.face_slots = take.words(c.neighbors + 1ull);
    b.faces = take.words(c.neighbors);
    b.large_faces = take.words(c.neighbors);
    b.huge_faces = take.words(c.neighbors);
    b.cap_counts = take.words(c.neighbors);
    b.cap_offsets = take.words(c.neighbors + 1ull);
    b.loose_caps = take.quads(2ull * c.segments);
    b.nodes = take.quads(2ull * c.segments);
    b.rings = take.quads(2ull * c.segments);
    b.loops = take.quads(2ull * c.segments);
}

void layOutPieces(Taker& take, const Capacities& c, EventBuffers& b) {
    uint64_t n = c.pieces;
    b.pieces = take.quads(n);
    b.sources = take.words(n);
    b.parents = take.words(n);
    b.edge_table = take.words(c.edgeTable());
    b.flags = take.quads(n);
    b.flag_offsets = take.quads(n + 1);
    b.keys = take.words(n);
    b.values = take.words(n);
    b.other_keys = take.words(n);
    b.other_values = take.words(n);
    uint64_t tiles = n / RADIX_TILE + 1;
    b.histogram = take.words(tiles << RADIX_BITS);
    b.digit_offsets = take.words((tiles << RADIX_BITS) + 1);
    b.components = take.words(n);
    b.component_start = take.words(c.components + 1ull);
    b.records = take.words(24ull * c.components);
    b.fates = take.words(2ull * c.components);
    b.cavities = take.words(c.components);
    b.ordered_cavities = take.words(c.components);
    b.classes = take.quads(n);
    b.class_offsets = take.quads(n + 1);
    b.demands = take.quads(c.components);
    b.demand_offsets = take.quads(c.components + 1ull);
    b.shares = take.quads(c.components);
}

} // namespace

void layOut(engine::ScratchArena& arena, const Capacities& c, const Mesh& mesh, const TriangleColumns& columns, EventBuffers& b) {
    Taker take(arena);
    uint64_t longest = std::max({uint64_t{c.pieces}, uint64_t{c.edges}, uint64_t{c.neighbors}, uint64_t{c.bins}, uint64_t{c.voronoi_edges}});
    b.counts = take.words(STATUS_WORDS);
    b.args = take.words(9ull * COUNT_TOTAL);
    b.sums = take.quads(longest / SCAN_BLOCK + 2);
    b.mesh_positions = take.words(3 * mesh.positions.size());
    b.mesh_triangles = take.words(3 * mesh.triangles.size());
    b.triangle_edges = take.words(3 * mesh.triangles.size());
    b.mesh_edges = take.words(2ull * c.edges);
    b.corner_attributes = take.words(15 * mesh.triangles.size());
    b.grid_vertices = take.quads(c.vertices);
    layOutSites(take, c, columns, b);
    layOutCells(take, c, b);
    layOutClip(take, c, b);
    layOutCaps(take, c, b);
    layOutPieces(take, c, b);
}

} // namespace brittle
