// One fracture event while it is recorded: what breaks, in which frame, with which buffers. The stages are functions that
// record kernels in the order of the pipeline; none waits for the device.
#pragma once

#include "modules/brittle/fracture/collider_pools.h"
#include "modules/brittle/fracture/fracture.h"
#include "modules/brittle/fracture/pools.h"
#include "modules/brittle/fracture/recorder.h"

namespace brittle {

struct ScenePools {
    engine::BufferView vertices, indices, draw_commands, objects, matrices, bounds, fragments;
};

// By which sites are placed in a mesh that the host has, and moved there.
struct Placement {
    const Mesh& mesh;
    const FractureOptions& options;
    const TriangleColumns& columns;
};

// The host need not know the mesh: how much there is of it, and how many sites were asked for, stands in the counts
// (COUNT_MESH_VERTICES and those behind it), with the arguments of the dispatches over them.
struct Event {
    const EventGrid& grid;
    const Capacities& capacity;
    const EventBuffers& b;
    ScenePools scene;
    Recorder& record;
    Search search = Search::Grid; // never Auto
    uint32_t turn_budget = 0;     // loop turns of a lane of cut_cells
    ColliderPools colliders = {}; // where they were asked for
    CellMapping cells = CellMapping::Auto;
    Caps caps = Caps::Exact;
    bool only_cells = false;
    const Placement* placement = nullptr; // where there is one
};

// Loop turns that a lane of cut_cells may take.
uint32_t turnBudget(const engine::Device& device, uint32_t group_size, Search search, uint32_t sites);
// Triangles that one dispatch of `emit` can reach.
uint32_t emitWindow(const VkPhysicalDeviceLimits& limits);
// Mesh triangles whose corners' normals and texture coordinates can be bound at once.
uint32_t sourceWindow(const VkPhysicalDeviceLimits& limits);

// Everything, once the mesh's vertices are on the grid and sites are in raw_sites.
void recordFracture(const Event& e);

// place_sites: vertices on the grid, and sites where none are given. Wants a placement.
void recordPlacement(const Event& e);
// neighbor_grid: welds and bins what stands in raw_sites
void recordSites(const Event& e);
void recordKeptSites(const Event& e); // the same without a label
// sphere_tree
void recordSphereTree(const Event& e);
// cut_cells, link_cells
void recordCutting(const Event& e);
void recordCells(const Event& e);
// relax_sites: one round, after which sites are welded and binned anew. Wants a placement.
void recordRelaxation(const Event& e);
// pair_wedges: where the surface may touch itself
void recordWedges(const Event& e);
// classify_triangles, clip_triangles
void recordClassification(const Event& e);
void recordClipping(const Event& e);
// place_vertices, classify_cells, cap_faces
void recordPlaces(const Event& e);
void recordDepth(const Event& e);
void recordCaps(const Event& e);
// The caps of faces that cap_fans has listed as vast: a stage of recordCaps. Wants room for them.
void recordVastCaps(const Event& e);
// split_islands, mass_properties, allocate, emit
void recordIslands(const Event& e);
void recordMassProperties(const Event& e);
void recordEmission(const Event& e);
// support_heights, part_islands, collider: where they were asked for
void recordColliders(const Event& e);

// Sorts pairs of lists by key, stably; `count` says how long they are. Keys must lie below the number of components that there
// is room for.
void recordSort(const Event& e, uint32_t count, const engine::BufferView (&keys)[2], const engine::BufferView (&values)[2]);

} // namespace brittle
