// brittle shatter, apart from its options and its output.
#pragma once

#include "modules/brittle/fracture/fracture.h"
#include "modules/brittle/fracture/verify.h"
#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/repair/repair.h"
#include "tools/brittle/auto_setting.h"
#include "tools/brittle/simulation.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cli {

// The fragments fall and are simulated; the output is their motion (motion_output.h).
struct DropOptions {
    std::optional<double> height; // above the ground; half of the model's own if nothing else is said
    double seconds = 3;
    double fps = kUsualFps;
};

struct ShatterOptions {
    std::string model, output, device;
    std::string sites_file; // instead of a number of sites
    std::string picture;    // of the fragments, moved apart
    std::string collider_picture;
    brittle::Pattern pattern = brittle::Pattern::Uniform;
    std::optional<brittle::Double3> at;     // where it is hit; the center of its box if nowhere else
    double strength = 1;                    // joules
    uint32_t relax = 0;                     // rounds of Lloyd's relaxation
    uint32_t candidates = PAPER_CANDIDATES; // a site, of the paper's pattern
    brittle::Search search = brittle::Search::Auto;
    brittle::Caps caps = brittle::Caps::Exact;
    brittle::CellMapping cells = brittle::CellMapping::Auto;
    brittle::Precision precision = brittle::Precision::Exact;
    double explode = 0;
    uint32_t sites = 100;
    uint64_t seed = 1;
    uint32_t group_size = 0; // lanes of a workgroup; 0: the usual number
    uint32_t collider = 0;   // directions; 0: none
    std::optional<DropOptions> drop;
    accuracy::Wish wish; // for a setting to be picked
    bool repair = false; // mend the model where it needs to be
    bool verify = false; // refuse fragments that break their contract
    bool as_json = false;
};

struct ShatterOutcome {
    std::string device;
    brittle::MeshReport model;
    brittle::RepairNotes mended; // where it was asked for
    brittle::FractureResult result;
    brittle::ContractReport contract;               // where it was asked for
    std::vector<std::pair<std::string, double>> ms; // by what was done, in order; the stages on the device among them
    double total_ms = 0;
    std::optional<AutoReport> picked;       // where there was a wish
    std::optional<SimulationReport> motion; // where they were dropped
};

using TellOutcome = std::function<engine::Result<void>(const ShatterOutcome&)>;

// Writes the output and the pictures that were asked for: all or none. They come to their places after `tell` has told the
// outcome, and only if it could.
engine::Result<void> shatter(const ShatterOptions& options, const TellOutcome& tell);

} // namespace cli
