#include "modules/brittle/fracture/pools.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace brittle {

uint32_t tableSize(uint64_t entries) { return static_cast<uint32_t>(std::bit_ceil(std::max<uint64_t>(2 * entries, 64))); }

namespace {

struct Extents {
    double edge_length = 0, longest_edge = 0, area = 0, cell = 1;
};

// Thinner than a cell, a plate is cut in two directions only, and a rod in one.
double usualCell(const EventGrid& grid, uint32_t site_count) {
    std::array<double, 3> extent;
    for (size_t k = 0; k < 3; k++)
        extent[k] = grid.mesh_high[k] - grid.mesh_low[k] + 1.0;
    std::sort(extent.begin(), extent.end());
    double cell = std::cbrt(extent[0] * extent[1] * extent[2] / site_count);
    if (extent[0] < cell) cell = std::sqrt(extent[1] * extent[2] / site_count);
    if (extent[1] < cell) cell = extent[2] / site_count;
    return std::max(cell, 1.0);
}

// Lengths in grid steps: a cell's usual size, and how much surface and edge there is to be cut.
Extents measureExtents(const Mesh& mesh, const MeshTopology& topology, const EventGrid& grid, uint32_t site_count) {
    Extents x;
    auto difference = [&](uint32_t a, uint32_t b) {
        Double3 d;
        for (size_t k = 0; k < 3; k++)
            d[k] = (static_cast<double>(mesh.positions[b][k]) - mesh.positions[a][k]) * grid.scale;
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
    x.cell = usualCell(grid, site_count);
    return x;
}

} // namespace

uint32_t Capacities::siteTable() const { return tableSize(sites); }
uint32_t Capacities::pairTable() const { return tableSize(pairs); }
uint32_t Capacities::pointTable() const { return tableSize(points()); }
uint32_t Capacities::flapTable() const { return rare.flaps ? tableSize(flap_sides) : 1; }
uint32_t Capacities::vastLeaves() const { return std::bit_ceil(std::max(vast_sides, 1u)); }
uint32_t Capacities::edgeTable() const { return tableSize(uint64_t{3} * pieces / 2); }

Capacities usualCapacities(const Amounts& of) {
    const auto size = [](double n) { return static_cast<uint32_t>(std::min(n, 2e8)); };
    const double n = of.sites;
    Capacities c;
    c.sites = of.sites;
    c.vertices = of.vertices;
    c.edges = of.edges;
    c.triangles = of.triangles;
    c.neighbors = size(20 * n + 2048);
    c.corners = size(34 * n + 4096);
    c.voronoi_vertices = size(9 * n + 1024);
    c.voronoi_edges = size(14 * n + 2048);
    c.crossings = size(2.5 * of.cuts + 0.02 * c.edges + 2048);
    c.pairs = size(2.5 * c.crossings + 4 * of.patches + 4096);
    c.polygons = c.pairs;
    c.sides = size(4.5 * c.polygons);
    c.triples = size(0.6 * c.pairs + 3 * of.patches + 1024);
    c.fans = size(2.5 * c.polygons);
    c.intervals = size(c.voronoi_edges + c.triples * 0.6);
    c.segments = size(3.0 * c.intervals + 1.2 * c.crossings + 1.5 * c.triples);
    // Two a segment of the faces that a lane cannot do: all of them in few cells, hardly any in many.
    c.nodes = std::min(2 * c.segments, std::max(1u << 18, c.segments / 2));
    c.caps = size(0.62 * c.segments + 1024);
    c.flap_sides = size(c.caps / 4.0 + 4096);
    c.pieces = c.triangles + c.fans + 2 * c.caps;
    c.components = size(std::min<double>(c.pieces, 6 * n + 0.1 * c.triangles + 16384));
    c.fragments = c.components;
    c.emitted = c.pieces;
    c.exact_medium = size(std::min(n, 512.0));
    c.exact_large = size(std::min(n, 8.0));
    // A round reaches one cell further in from the triangle's edges.
    c.clip_rounds = 3 + size(std::min(64.0, of.longest_edge));
    return c;
}

Capacities estimateCapacities(const Mesh& mesh, const MeshTopology& topology, const EventGrid& grid, uint32_t site_count) {
    const Extents x = measureExtents(mesh, topology, grid, site_count);
    const bool whole = site_count == 1;
    Capacities c =
        usualCapacities({site_count, static_cast<uint32_t>(mesh.positions.size()), static_cast<uint32_t>(topology.edges.size()),
                         static_cast<uint32_t>(mesh.triangles.size()), whole ? 0 : x.edge_length / x.cell,
                         whole ? 0 : x.area / (x.cell * x.cell), x.longest_edge / x.cell});
    c.bins = grid.binCount();
    // Where they are to be expected an event that found out would only be made twice.
    c.rare.exact_cells = site_count > 256;
    c.rare.flaps = site_count > 256 || c.triangles > 8192;
    return c;
}

namespace {

bool takeUp(bool& recorded, bool met) {
    bool news = met && !recorded;
    recorded = recorded || met;
    return news;
}

} // namespace

// Of faces every piece has those of its cell, and the directions that its cell does not make up for: about a third of them.
Capacities withColliders(Capacities c, uint32_t directions) {
    if (directions == 0) return c;
    c.collider_directions = directions;
    c.colliders = std::min(c.components, c.sites + c.sites / 4 + 256);
    c.island_pairs = c.partings = 1024;
    c.collider_faces = c.colliders * (16 + directions / 3);
    c.collider_vertices = 2 * c.collider_faces;
    c.collider_corners = 6 * c.collider_faces;
    return c;
}

Capacities forCellsOnly(Capacities c) {
    constexpr uint32_t kLittle = 16;
    for (uint32_t* pool : {&c.crossings, &c.pairs, &c.polygons, &c.sides, &c.triples, &c.fans, &c.intervals, &c.segments,
                           &c.nodes, &c.caps, &c.pieces, &c.components, &c.fragments, &c.emitted})
        *pool = std::min(*pool, kLittle);
    return c;
}

void Capacities::add(const Capacities& other) {
    for (uint32_t Capacities::*pool :
         {&Capacities::sites,         &Capacities::vertices,    &Capacities::edges,      &Capacities::triangles,
          &Capacities::bins,          &Capacities::neighbors,   &Capacities::corners,    &Capacities::voronoi_vertices,
          &Capacities::voronoi_edges, &Capacities::crossings,   &Capacities::pairs,      &Capacities::polygons,
          &Capacities::sides,         &Capacities::triples,     &Capacities::fans,       &Capacities::intervals,
          &Capacities::segments,      &Capacities::nodes,       &Capacities::caps,       &Capacities::flap_sides,
          &Capacities::pieces,        &Capacities::components,  &Capacities::fragments,  &Capacities::emitted,
          &Capacities::exact_medium,  &Capacities::exact_large, &Capacities::vast_sides, &Capacities::vast_spans})
        this->*pool += other.*pool;
    clip_rounds = std::max(clip_rounds, other.clip_rounds);
    rare = rare.joined(other.rare);
}

bool Capacities::grow(const uint32_t* status) {
    const uint32_t* needed = status + STATUS_NEEDED;
    bool more = takeUp(rare.exact_cells, status[COUNT_EXACT_SMALL] != 0);
    more |= takeUp(rare.medium_cells, status[COUNT_EXACT_MEDIUM] != 0);
    more |= takeUp(rare.large_cells, status[COUNT_EXACT_MEDIUM] != 0); // who needs the one often needs the other
    more |= takeUp(rare.huge_faces, status[COUNT_HUGE_FACES] != 0);
    if (takeUp(rare.flaps, status[COUNT_SUSPECTS] != 0)) {
        flap_sides = std::max(flap_sides, 2 * status[COUNT_SUSPECTS]);
        more = true;
    }
    more |= takeUp(rare.films, status[COUNT_FILMS] != 0);
    more |= takeUp(rare.cavities, status[COUNT_CAVITIES] != 0);
    more |= takeUp(rare.partings, status[COUNT_PARTINGS] != 0);
    if (status[COUNT_VAST_SIDES] > vast_sides) {
        vast_sides = status[COUNT_VAST_SIDES] + status[COUNT_VAST_SIDES] / 4;
        vast_spans = std::max(vast_spans, 8 * vast_sides);
        more = true;
    }
    if (status[STATUS_SIDES] > sides_per_polygon && sides_per_polygon < MOST_SIDES) {
        sides_per_polygon = std::min<uint32_t>(std::max(64u, 2 * status[STATUS_SIDES]), MOST_SIDES);
        more = true;
    }
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
    fit(nodes, COUNT_NODES);
    fit(caps, COUNT_CAP_TRIANGLES);
    fit(flap_sides, COUNT_SUSPECT_SIDES);
    fit(vast_spans, COUNT_VAST_SPANS);
    fit(components, COUNT_COMPONENTS);
    fit(exact_medium, COUNT_EXACT_MEDIUM);
    fit(exact_large, COUNT_EXACT_LARGE);
    fit(colliders, COUNT_COLLIDERS);
    fit(island_pairs, COUNT_ISLAND_PAIRS);
    fit(partings, COUNT_PARTINGS);
    fit(collider_faces, COUNT_COLLIDER_FACES);
    fit(collider_vertices, COUNT_COLLIDER_VERTICES);
    fit(collider_corners, COUNT_COLLIDER_CORNERS);
    polygons = std::max(polygons, pairs);
    pieces = triangles + fans + 2 * caps;
    fragments = components;
    emitted = pieces;
    return true;
}

} // namespace brittle
