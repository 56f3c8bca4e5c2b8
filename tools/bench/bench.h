// What cells and whole shatters cost, and what others take for the same on the same machine in the same run.
//
// Ours and the peer's runs alternate, so that a machine that is busy for a while is busy for both, and medians are reported.
// Peers run on one thread; we run on the device, which on a CPU device means all its threads.
#pragma once

#include "engine/device.h"
#include "engine/result.h"

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace bench {

struct BenchOptions {
    std::vector<uint32_t> cell_counts = {100, 1'000, 10'000, 100'000}; // sites in a cube
    std::vector<uint32_t> shatter_counts = {10, 100, 1'000};           // sites in the bumpy sphere
    uint32_t sphere_level = 5;                                         // 20 * 4^level triangles
    std::vector<uint32_t> growth_levels = {3, 4, 5, 6, 7};             // of the sphere, for time against triangles
    uint32_t growth_sites = 100;
    std::vector<uint32_t> variant_cell_counts = {100, 1'000, 10'000}; // sites in a cube, cut in every way there is
    std::vector<uint32_t> variant_shatter_counts = {100};             // and in the bumpy sphere
    std::vector<uint32_t> collider_directions = {6, 14, 26, 62};      // for every number of sites that is shattered
    uint32_t startup_rounds = 3;
    uint32_t peer_shatter_limit = 100; // CGAL runs up to here
    uint32_t rounds = 5;
    uint64_t seed = 1;
    uint32_t group_size = 0;     // lanes of a workgroup; 0: the usual number
    bool only_colliders = false; // of the shatters
    bool kernels = false;        // time every kernel as well, in runs of their own
};

using Times = std::vector<std::pair<std::string, double>>; // milliseconds of device time, in order

// Medians in milliseconds; 0 where there was no peer to run.
struct CellsRow {
    uint32_t sites = 0;
    double ms = 0;        // device time of binning the sites and cutting the cells: neighbors and corners of each, by id
    double link_ms = 0;   // and of packing them into one diagram, edges tied to vertices; the peers make none
    double voropp_ms = 0; // filling the container and computing every cell with its neighbors
    Times kernels;        // where asked for
};

struct ShatterRow {
    uint32_t sites = 0;
    size_t triangles = 0, fragments = 0;
    double ms = 0;         // the whole call, from arrays in host memory to fragments in host memory
    double device_ms = 0;  // from submission to completion
    double cgal_ms = 0;    // the hull of every cell and its intersection with the model
    Times stages, kernels; // kernels where asked for
};

// caps=exact and caps=convex alternately, on a convex model.
struct CapsRow {
    uint32_t sites = 0;
    size_t triangles = 0;
    double exact_ms = 0, convex_ms = 0;           // the whole call
    double exact_caps_ms = 0, convex_caps_ms = 0; // of that the stage cap_faces, on the device
};

// A search, a mapping of cells or a precision, next to the default.
struct VariantRow {
    std::string name;
    uint32_t sites = 0;
    bool only_cells = false;
    double ms = 0;         // device time: of binning and cutting cells, or of the whole shatter
    double default_ms = 0; // of the default in the same run
};

// Colliders of a shatter, next to the whole of it, in the same runs.
struct ColliderRow {
    uint32_t sites = 0, directions = 0;
    size_t pieces = 0, planes = 0;
    double volume_excess = 0; // of all pieces over all fragments, as a part of these
    double ms = 0;            // device time of the colliders
    double shatter_ms = 0;    // and of all else
    Times kernels;            // where asked for: the colliders' own
};

struct StartupRow {
    double cold_ms = 0, warm_ms = 0; // a process that breaks 1280 triangles into 10 cells, without and with the driver's cache
};

// Called with one line before each step.
using Progress = std::function<void(const std::string&)>;

engine::Result<std::vector<CellsRow>> benchCells(engine::Device& device, const BenchOptions& options, const Progress& progress);
engine::Result<std::vector<ShatterRow>> benchShatter(engine::Device& device, const BenchOptions& options,
                                                     const Progress& progress);

// The same number of sites in spheres of ever more triangles.
engine::Result<std::vector<ShatterRow>> benchGrowth(engine::Device& device, const BenchOptions& options,
                                                    const Progress& progress);
engine::Result<std::vector<CapsRow>> benchCaps(engine::Device& device, const BenchOptions& options, const Progress& progress);
engine::Result<std::vector<VariantRow>> benchVariants(engine::Device& device, const BenchOptions& options,
                                                      const Progress& progress);
engine::Result<std::vector<ColliderRow>> benchColliders(engine::Device& device, const BenchOptions& options,
                                                        const Progress& progress);
engine::Result<StartupRow> benchStartup(engine::Device& device, const BenchOptions& options, const Progress& progress);

double median(std::vector<double> samples); // 0 of none

} // namespace bench
