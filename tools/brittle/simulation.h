// A scene from its first step to its last: what brittle simulate and brittle shatter --drop have in common.
#pragma once

#include "engine/device.h"
#include "modules/brittle/dynamics/scene_contents.h"
#include "tools/brittle/event_report.h"
#include "tools/brittle/motion_output.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cli {

constexpr double kUsualFps = 60;

struct StagedScene {
    brittle::SceneDescription scene;
    brittle::WorldContents contents;
    brittle::WorldSurfaces surfaces;                        // only read where there is an output
    std::function<void(brittle::StepSettings&)> adjust;     // of the scene's settings; none: as they are
    std::string room_advice = "see [budgets] in the scene"; // where something does not fit
};

struct Staging {
    std::string source; // the file or the built-in scene, as it was asked for
    uint32_t group_size = 0;
    bool has_surfaces = false;
};

// Makes the bodies of a scene, and breaks what begins broken. Errors: with the scene's name.
engine::Result<StagedScene> stageScene(engine::Device& device, brittle::SceneDescription scene, const Staging& staging);
// A world of it, with its settings and budgets. Errors: likewise, Capacity with the key of the scene to raise.
engine::Result<std::unique_ptr<brittle::World>> worldOf(engine::Device& device, const StagedScene& staged, uint32_t group_size);

struct SimulationReport {
    std::string scene;
    uint32_t steps = 0;
    double seconds = 0;
    size_t frames = 0; // that were written
    brittle::WorldCounts counts;
    EventReport told;
    uint32_t movers = 0;                // at the beginning; the other bodies are colliders
    uint32_t colliders = 0, pieces = 0; // likewise
    uint32_t movers_left = 0;           // at the end, after some have become fragments
    uint32_t dispatches = 0;            // of a step
    // Wall clock of a step, with the wait for it. The first is apart: the driver compiles kernels in it.
    double first_ms = 0, median_ms = 0, p99_ms = 0;
    std::vector<std::pair<std::string, double>> shares; // of stages in the device time of all steps
    double kinetic_energy = 0;                          // J, at the end
    std::optional<brittle::Dust> dust;                  // at the end, where there is such an effect
    uint64_t state_hash = 0;                            // World::hash, at the end
};

// In whole steps: `seconds` is rounded up to them; none: as many steps as the scene says. `output` may be nullptr; it is
// finished, not committed; surfaces of fragments are added to `staged` for it. Errors: what the world says, Capacity with the
// key of the scene to raise.
engine::Result<SimulationReport> simulate(engine::Device& device, StagedScene& staged, std::optional<double> seconds,
                                          uint32_t group_size, MotionOutput* output);

nlohmann::ordered_json simulationJson(const SimulationReport& report);
void printSimulation(const SimulationReport& report, const std::string& output);
std::string hexOf(uint64_t hash); // 16 digits

} // namespace cli
