// What cells, whole shatters and rigid bodies cost, and what others take for the same on the same machine in the same run.
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

// So many bodies that break in one frame, into so many cells each, and bodies that only lie there.
struct BreakingCase {
    uint32_t bodies = 10, cells = 64, bystanders = 0;
};

struct BenchOptions {
    std::vector<uint32_t> cell_counts = {100, 1'000, 10'000, 100'000}; // sites in a cube
    std::vector<uint32_t> shatter_counts = {10, 100, 1'000};           // sites in the bumpy sphere
    uint32_t sphere_level = 5;                                         // 20 * 4^level triangles
    std::vector<uint32_t> growth_levels = {3, 4, 5, 6, 7};             // of the sphere, for time against triangles
    uint32_t growth_sites = 100;
    std::vector<uint32_t> variant_cell_counts = {100, 1'000, 10'000}; // sites in a cube, cut in every way there is
    std::vector<uint32_t> variant_shatter_counts = {100};             // and in the bumpy sphere
    std::vector<uint32_t> collider_directions = {6, 14, 26, 62};      // for every number of sites that is shattered
    std::vector<uint32_t> pile_counts = {100, 1'000};                 // hulls that fall into a pit
    uint32_t pile_steps = 300;                                        // of a sixtieth of a second
    std::vector<uint32_t> box_counts = {1'000, 10'000, 100'000};      // of the broad phase
    std::vector<uint32_t> pair_counts = {10'000};                     // of hulls, of the narrow phase
    // The first one with every set of effects, too.
    std::vector<BreakingCase> breaking_cases = {{10, 64, 0}, {1, 64, 0},   {3, 64, 0},    {20, 64, 0},
                                                {10, 16, 0}, {10, 128, 0}, {10, 64, 100}, {10, 64, 1000}};
    uint32_t startup_rounds = 3;
    uint32_t peer_shatter_limit = 100; // CGAL runs up to here
    uint32_t rounds = 5;
    uint64_t seed = 1;
    uint32_t group_size = 0;     // lanes of a workgroup; 0: the usual number
    bool only_colliders = false; // of the shatters
    bool peers = true;           // run other libraries as well, if the build has them
    bool effects = true;         // of the first breaking case also with each set of effects
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

// How a pile lies in the end: overlaps of the bodies as they are, without margins, by the separating axis theorem in double
// precision, the same for us and every peer.
struct PileState {
    double penetration_p99 = 0, penetration_most = 0; // m, of the pairs that overlap
    size_t overlaps = 0;                              // how many of them
    double energy = 0;                                // J, kinetic
    double height = 0;                                // m, mean of the centers of mass: margins make piles higher
    size_t escaped = 0;                               // bodies whose center of mass is behind one of the pit's planes
};

struct PilePeer {
    std::string name;
    double ms = 0; // a step
    PileState state;
};

// The built-in scene hull_pile_N, all bodies awake. Blocks of ten steps alternate with those of the peers, which have the same
// bodies in the same places.
struct PileRow {
    uint32_t bodies = 0, steps = 0;
    double ms = 0;                                                // a step, submission and wait included: the mean of all
    uint32_t dispatches = 0, pairs = 0, contacts = 0, colors = 0; // of the last step
    PileState state;
    Times stages; // of the device, a step: the mean over the last step of each block
    std::vector<PilePeer> peers;
};

// Boxes as dense as in a heap, each of which moves on by up to three centimeters along each axis between two runs.
struct BroadPhaseRow {
    uint32_t boxes = 0;
    size_t pairs = 0;
    double ms = 0;           // device time, all of it anew
    size_t bullet_pairs = 0; // of boxes that it has made a little larger
    // Of its dynamic trees; 0 where it is not in the build.
    double bullet_build_ms = 0; // all of it anew
    double bullet_ms = 0;       // boxes moved within the trees, which it keeps, and pairs brought up to date
};

// Hulls of the pile, corner to face, from a centimeter apart to a centimeter deep.
struct NarrowPhaseRow {
    uint32_t pairs = 0, touching = 0;
    double ms = 0; // device time
};

// Sixty frames in which all of them break at once, over and over: frames as a host sees them, submission and wait included.
struct BreakingRow {
    BreakingCase what;
    std::vector<std::string> effects;
    uint32_t broken = 0, fragments = 0;              // in the frame in which things break first
    double p50_ms = 0, p99_ms = 0;                   // of all frames of all rounds
    double before_ms = 0, break_ms = 0, next_ms = 0; // medians over the rounds: of means, of that frame and the next one
    double after_ms = 0;                             // and of means of all after it
    uint64_t bytes = 0;                              // on the device
    Times stages, next_stages;                       // of that frame and the next one
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
engine::Result<std::vector<PileRow>> benchPiles(engine::Device& device, const BenchOptions& options, const Progress& progress);
engine::Result<std::vector<BroadPhaseRow>> benchBroadPhase(engine::Device& device, const BenchOptions& options,
                                                           const Progress& progress);
engine::Result<std::vector<NarrowPhaseRow>> benchNarrowPhase(engine::Device& device, const BenchOptions& options,
                                                             const Progress& progress);
engine::Result<std::vector<BreakingRow>> benchBreaking(engine::Device& device, const BenchOptions& options,
                                                       const Progress& progress);
engine::Result<std::vector<BreakingRow>> benchBreakingEffects(engine::Device& device, const BenchOptions& options,
                                                              const Progress& progress);
engine::Result<StartupRow> benchStartup(engine::Device& device, const BenchOptions& options, const Progress& progress);

double median(std::vector<double> samples); // 0 of none

} // namespace bench
