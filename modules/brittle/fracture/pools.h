// The buffers of one fracture event, and how much each may hold.
//
// Sizes that only the device finds out (how many crossings, polygons, caps...) are estimated from what the host knows. A
// pool that turns out too small stops the event, which then says what it would have needed; the event is recorded again
// with that.
#pragma once

#include "engine/arena.h"
#include "modules/brittle/fracture/event_grid.h"
#include "modules/brittle/fracture/triangle_columns.h"
#include "modules/brittle/mesh/mesh.h"
#include "shaders-spirv/shared/fracture.h"

#include <algorithm>
#include <array>
#include <functional>

namespace brittle {

// Words a cell of the two larger exact kernels leaves in `raw`.
constexpr uint32_t kMediumRaw = 2 + 256 + 2 * 512, kLargeRaw = 2 + 2048 + 2 * 4096;

// Slots of a hash table for so many entries: a power of two, at most half full.
uint32_t tableSize(uint64_t entries);

struct Capacities {
    uint32_t sites = 0, vertices = 0, edges = 0, triangles = 0, bins = 0; // exact
    uint32_t neighbors = 0, corners = 0, voronoi_vertices = 0, voronoi_edges = 0;
    uint32_t crossings = 0, pairs = 0, pair_table = 0, polygons = 0, sides = 0, triples = 0, fans = 0;
    uint32_t intervals = 0, segments = 0, nodes = 0, caps = 0, flap_sides = 0, pieces = 0, components = 0, fragments = 0,
             emitted = 0;
    uint32_t collider_directions = 0, colliders = 0, island_pairs = 0, partings = 0; // all 0 where none are asked for
    uint32_t collider_faces = 0, collider_vertices = 0, collider_corners = 0;
    uint32_t exact_medium = 0, exact_large = 0;
    uint32_t vast_sides = 0, vast_spans = 0; // 0: kernels of vast faces are not recorded, and an event that meets one fails
    uint32_t clip_rounds = 0;
    uint32_t sides_per_polygon = USUAL_SIDES;
    bool sphere_tree = false;
    bool tiled = false;         // of several objects
    bool touching = false;      // surfaces may touch themselves along edges
    bool relaxed = false;       // sites are still moved when cells have been cut
    uint32_t emit_window = 0;   // triangles that one dispatch of `emit` can reach
    uint32_t source_window = 0; // mesh triangles whose corner attributes it can reach; 0: all
    uint32_t sourceParts() const { return source_window == 0 ? 1 : (std::max(triangles, 1u) - 1) / source_window + 1; }
    uint32_t sourcesIn(uint32_t part) const {
        return source_window == 0 ? triangles : std::min(source_window, triangles - source_window * part);
    }
    // Kernels for rare cases are recorded, and so compiled, once an attempt has met such a case.
    struct Rare {
        bool exact_cells = false, medium_cells = false, large_cells = false, huge_faces = false, flaps = false, films = false,
             cavities = false, partings = false;
        Rare joined(const Rare& other) const {
            return {exact_cells || other.exact_cells,
                    medium_cells || other.medium_cells,
                    large_cells || other.large_cells,
                    huge_faces || other.huge_faces,
                    flaps || other.flaps,
                    films || other.films,
                    cavities || other.cavities,
                    partings || other.partings};
        }
    } rare;

    uint32_t vastFaces() const { return vast_sides / HUGE_FACE + 1; }
    uint32_t vastLeaves() const; // of the tree over the heights of their corners
    uint32_t points() const { return vertices + crossings + triples + voronoi_vertices; }
    // Slots of the hash tables.
    uint32_t siteTable() const;
    uint32_t pairTable() const;
    uint32_t pointTable() const;
    uint32_t flapTable() const;
    uint32_t edgeTable() const;
    // Room for both.
    void add(const Capacities& other);
    // Makes room for what an attempt found out that it needs, from the words of counts and status it left. False: nothing
    // is amiss that more room would cure.
    bool grow(const uint32_t* status);
};

// Room for colliders with so many directions.
Capacities withColliders(Capacities capacity, uint32_t directions);
// Without the pools that only stages after the cells use.
Capacities forCellsOnly(Capacities capacity);
// How much there is to be cut: how often edges are, and into how many patches the surface is; both in cells of usual size.
struct Amounts {
    uint32_t sites = 0, vertices = 0, edges = 0, triangles = 0;
    double cuts = 0, patches = 0, longest_edge = 0;
};
Capacities usualCapacities(const Amounts& of);
Capacities estimateCapacities(const Mesh& mesh, const MeshTopology& topology, const EventGrid& grid, uint32_t site_count);

// Views into the scratch arena. Groups share memory where one is read for the last time before the other is first written.
struct EventBuffers {
    using View = engine::BufferView;
    View counts, args, sums;
    // mesh
    std::vector<View> corner_attributes; // of so many mesh triangles each as Capacities::source_window says
    View mesh_positions, mesh_triangles, triangle_edges, mesh_edges, wedges, grid_vertices, vertex_tiles;
    // wedges, where the surface touches itself
    View place_table, place_slots, place_flags, first_vertices, named_sides, first_sides, side_heads, side_links, open_wedges;
    // sites
    View raw_sites, placed, column_start, column_triangles, columns, site_table, site_slots, welded_sites, site_flags,
        site_offsets;
    View sites, bin_counts, bin_start, bin_cursors, loose_sites, bin_sites;
    View tree, tree_path, tree_bids, leaf_counts, leaf_start, loose_leaves, leaf_sites; // of the sphere tree, if asked for
    // cells
    View raw, cell_raw, queue, store, cell_counts, cell_offsets, neighbors, corners, corner_info, vertex_sites, edge_sites,
        edge_ends;
    View face_cells;
    // classification and clipping
    View owners, edge_flags, edge_slot, mixed_edges, crossing_counts, crossing_offsets, crossings;
    View triangle_flags, triangle_slot, mixed_triangles, pairs, pair_table, pair_sides, pair_shape, round_bounds;
    View triangle_polygons, triangle_polygon_offsets, triangle_cursors, loose_polygons, polygons, polygon_counts,
        polygon_offsets;
    View polygon_sides, polygon_corners, triples, triple_signs;
    // places
    View points, positions, point_table, point_slots, exact_welded, welded, shared_points;
    // depth and caps
    View triple_edges, edge_triple_counts, edge_triple_offsets, edge_triple_cursors, edge_sums, loose_triples, ordered_triples;
    View links, other_links, interval_counts, interval_offsets, face_counts, face_offsets, face_cursors, segments;
    View face_flags, face_slots, faces, wide_faces, large_faces, huge_faces, loose_caps, cap_slots, cap_counts, cap_offsets,
        nodes, rings, loops;
    View vast_listed, vast_keys, vast_values, vast_other_keys, vast_other_values, vast_histogram, vast_digit_offsets;
    View vast_span_counts, vast_span_offsets, vast_spans;
    View vast_faces, vast_ends, vast_chords, vast_rings, vast_diagonals, vast_heads, vast_links, vast_halves, vast_marks,
        vast_labels, vast_other_labels, vast_flags, vast_offsets, vast_caps;
    // pieces
    View pieces, sources, parents, suspects, flap_table, flap_slots, flap_partners, edge_table, flags, flag_offsets, keys,
        values, other_keys, other_values, histogram, digit_offsets;
    View components, component_start, records, fates, cavities, films, parts, other_parts, classes, class_offsets, demands,
        demand_offsets, shares;
    // colliders
    View fragment_list, island_cells, other_island_cells, islands, other_islands, supports, surfaces, pair_counts, pair_offsets,
        island_pairs, pair_flags, pair_slots, parting_list, parting_ranges, partings, loose_colliders, collider_sizes,
        collider_offsets;
};

// Returns the bytes of the largest view.
// `beside_sites` takes what is read and written while sites are made ready, and no later.
using TakeMore = std::function<void(engine::ScratchArena&)>;
uint64_t layOut(engine::ScratchArena& arena, const Capacities& c, const TriangleColumns& columns, EventBuffers& b,
                const TakeMore& beside_sites = {});

} // namespace brittle
