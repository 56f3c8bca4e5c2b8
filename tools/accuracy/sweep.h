// The sweep over all knobs: one at a time and useful pairs, on workloads that stay the same, a turn each in every round.
#pragma once

#include "engine/device.h"
#include "tools/accuracy/progress_estimate.h"
#include "tools/accuracy/results.h"

#include <functional>
#include <string>
#include <vector>

namespace accuracy {

constexpr double kQuickSeconds = 155; // three minutes, less what an estimate may be off by, and other work beside it take

struct Options {
    bool is_quick = false;
    std::vector<std::string> models; // files or builtin:NAME, besides the workloads that are always there
    uint32_t group_size = 0;         // lanes of a workgroup; 0: the usual number
    uint32_t rounds() const { return is_quick ? 5 : 9; }
    uint32_t sceneRounds() const { return is_quick ? 3 : 5; }
};

struct Sweep {
    engine::Device& device;
    const Options& options;
    ProgressEstimate& progress;
    Results& results;

    // A quick run that will not be over in time does as little as its results can do with, where there is a choice.
    bool isLate() const { return options.is_quick && progress.expectedSeconds() > kQuickSeconds; }
};

// Compiles what drivers would compile one after the other while it is measured.
engine::Result<void> compileKernels(Sweep& sweep);
// Each adds its workloads, kinds of errors and measurements.
engine::Result<void> sweepFracture(Sweep& sweep);
engine::Result<void> sweepColliders(Sweep& sweep);
engine::Result<void> sweepPatterns(Sweep& sweep);
engine::Result<void> sweepDynamics(Sweep& sweep);
// The paper's two figures: time against the number of sites, and the share of each part.
engine::Result<void> measureFigures(Sweep& sweep);
// Energy over a minute, and how far stacks and heavy bodies are off, by both solvers.
engine::Result<void> drawCurves(Sweep& sweep);
// The same under the cheapest and the dearest setting, drawn.
engine::Result<void> drawPairs(Sweep& sweep);

// All of it, in this order, and what follows from it. Errors: of the device, of models.
engine::Result<Results> measureAll(engine::Device& device, const Options& options);

} // namespace accuracy
