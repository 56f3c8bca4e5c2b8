// Shatters a closed mesh into closed fragments on the compute queue.
#pragma once

#include "engine/commands.h"
#include "engine/device.h"
#include "engine/kernel.h"
#include "engine/result.h"
#include "modules/brittle/fracture/caps.h"
#include "modules/brittle/fracture/cell_mapping.h"
#include "modules/brittle/fracture/fragments.h"
#include "modules/brittle/fracture/pattern.h"
#include "modules/brittle/fracture/precision.h"
#include "modules/brittle/fracture/search.h"
#include "modules/brittle/mesh/mesh.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace brittle {

struct FractureOptions {
    uint32_t site_count = 100; // asked of the pattern; ignored where sites are given
    uint64_t seed = 1;
    std::vector<Double3> given_sites; // model space; instead of a pattern
    Pattern pattern = Pattern::Uniform;
    Impact impact;      // of the patterns that have one
    uint32_t relax = 0; // rounds in which each site goes to the centroid of its cell (Lloyd 1982)
    Search search = Search::Auto;
    Caps caps = Caps::Exact;
    CellMapping cells = CellMapping::Auto;  // edges: by grid, other searches are refused
    Precision precision = Precision::Exact; // less may break the contract of fragments; see verifyContract
    uint32_t collider = 0;                  // directions of colliders: 6, 14, 26 or 62; 0: none are made, which costs nothing
    bool only_cells = false;                // stop once the Voronoi cells are there: no fragments, for measuring
    bool time_kernels = false;              // timings name kernels, not stages
};

struct FractureCounts {
    uint32_t sites_requested = 0, sites_used = 0, sites_welded = 0;
    uint32_t cells_ok = 0, cells_empty = 0, cells_refused = 0;
    uint32_t cells_merged = 0;     // parts of cells that are too thin to stand alone: part of a neighbor's fragment
    uint32_t pieces_dissolved = 0; // as thin, without a neighbor that they lie against
    uint32_t exact_total = 0, exact_redone = 0; // cells, and those done again by the exact kernel
};

struct FractureResult {
    FragmentSet fragments;
    FractureCounts counts;
    std::vector<Double3> sites;          // used, in model space: what Fragment::cell points into
    std::vector<engine::Timing> timings; // one per stage, milliseconds on the device
    double total_ms = 0;                 // of the recorded work, wall clock
    double setup_ms = 0;                 // making pipelines and buffers
};

// One of several objects that break at once.
struct BreakingObject {
    const Mesh& mesh;
    const MeshTopology& topology;
    std::vector<Double3> sites; // model space, at least one
};

// Keeps its general buffer from one shatter to the next, until one needs more, or less than an eighth of it.
class Fracture {
public:
    // `group_size`: lanes of a workgroup in the kernels that run a lane an element, a power of two from 8 to 256 that the
    // device takes, or 0 for the usual number. It decides how work is spread over the device; fragments are the same, bit for
    // bit. Errors: BadInput (another group size).
    static engine::Result<std::unique_ptr<Fracture>> create(engine::Device& device, uint32_t group_size = 0);
    virtual ~Fracture() = default;
    // Errors: BadInput (no sites, sites too far away; radial_sites.h), Capacity (names pool and what it lacked), Device (also
    // where it lacks doubles that were asked for), Internal (signs that contradict each other: only at less than exact
    // precision).
    virtual engine::Result<FractureResult> shatter(const Mesh& mesh, const MeshTopology& topology,
                                                   const FractureOptions& options) = 0;
    // Breaks up to 256 objects by one recording: a result for each, as shatter would have it of each alone, but for the order
    // of fragments and corners; times stand with the first. Of the options those count that say how: caps, precision, collider,
    // time_kernels. Errors: as above, with the object's number, counted from 1, where it is one object's.
    virtual engine::Result<std::vector<FractureResult>> shatterTogether(std::span<const BreakingObject> objects,
                                                                        const FractureOptions& options) = 0;
};

} // namespace brittle
