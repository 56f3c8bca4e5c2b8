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

struct Event {
    const Mesh& mesh;
    const FractureOptions& options;
    const EventGrid& grid;
    const TriangleColumns& columns;
    const Capacities& capacity;
    const EventBuffers& b;
    const ScenePools& scene;
    Recorder& record;
    Search search;                // never Auto
    uint32_t turn_budget;         // loop turns of a lane of cut_cells
    ColliderPools colliders = {}; // where they were asked for
};

// place_sites, neighbor_grid
void recordSites(const Event& e);
void recordKeptSites(const Event& e); // welds and bins what stands in raw_sites
// sphere_tree
void recordSphereTree(const Event& e);
// cut_cells, link_cells
void recordCutting(const Event& e);
void recordCells(const Event& e);
// relax_sites: one round, after which sites are welded and binned anew
void recordRelaxation(const Event& e);
// classify_triangles, clip_triangles
void recordClassification(const Event& e);
void recordClipping(const Event& e);
// place_vertices, classify_cells, cap_faces
void recordPlaces(const Event& e);
void recordDepth(const Event& e);
void recordCaps(const Event& e);
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
