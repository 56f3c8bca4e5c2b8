#include "tools/accuracy/judge.h"
#include "tools/accuracy/machine.h"
#include "tools/accuracy/sweep.h"
#include "tools/bench/peers.h"

namespace accuracy {
namespace {

using engine::Result;

// CGAL's answer to what fracture is asked for: the hull of every cell, and its intersection with the model.
void addPeers(Sweep& sweep) {
    sweep.progress.show("CGAL", 0);
    std::vector<double> ms;
    double volume_error = 0;
    for (uint32_t round = 0; round < (sweep.options.is_quick ? 1 : 3); ++round)
        if (const auto peer = bench::cgalShatter(5, 100, 1)) {
            ms.push_back(peer->ms);
            volume_error = peer->volume_error;
        }
    if (ms.empty()) return;
    sweep.results.peers.push_back({"CGAL, one thread, the cells not counted",
                                   "bumpy_20480",
                                   samplesOf(std::move(ms)),
                                   {{"volume", volume_error, 1e-12}}});
}

struct Part {
    const char* name;
    double share; // of the time
    Result<void> (*run)(Sweep& sweep);
};
// Compiling takes half a minute or next to nothing, which tells nothing about the others.
constexpr Part kParts[] = {{"compiling", 0, compileKernels},   {"fracture", .18, sweepFracture},
                           {"colliders", .04, sweepColliders}, {"patterns", .03, sweepPatterns},
                           {"dynamics", .44, sweepDynamics},   {"figures", .16, measureFigures},
                           {"curves", .10, drawCurves},        {"pictures", .04, drawPairs}};

} // namespace

Result<Results> measureAll(engine::Device& device, const Options& options) {
    Results results;
    ProgressEstimate progress;
    Sweep sweep{device, options, progress, results};
    results.machine = describeMachine(device);
    results.machine.is_quick = options.is_quick;
    results.machine.rounds = options.rounds();
    results.machine.scene_rounds = options.sceneRounds();
    for (const Part& part : kParts) {
        progress.begin(part.name, part.share);
        const double begun = progress.seconds();
        if (auto done = part.run(sweep); !done) return done.error();
        results.parts.push_back({part.name, progress.seconds() - begun});
        judge(results); // pictures are of what was cheapest and dearest
    }
    progress.begin("others", .01);
    addPeers(sweep);
    results.machine.seconds = progress.seconds();
    results.machine.processor_seconds = processorSeconds();
    return results;
}

} // namespace accuracy
