// brittle simulate: a scene in motion, as an animation, a picture, a film, or numbers.
#include "tools/brittle/auto_setting.h"
#include "tools/brittle/command.h"
#include "tools/brittle/motion_output.h"
#include "tools/brittle/progress.h"
#include "tools/brittle/scene_files.h"
#include "tools/brittle/scene_source.h"
#include "tools/brittle/simulation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cli {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;

struct SimulateOptions {
    std::string scene, output, device;
    std::optional<double> seconds;
    double fps = kUsualFps;
    uint32_t group_size = 0;
    accuracy::Wish wish; // for a setting to be picked
    bool state_hash = false;
    bool as_json = false;
};

struct SimulateOutcome {
    std::string device;
    SimulationReport report;
    std::optional<AutoReport> picked; // where there was a wish
};

Result<std::unique_ptr<MotionOutput>> openOutput(const SimulateOptions& options, const brittle::SceneDescription& scene) {
    if (options.output.empty()) return std::unique_ptr<MotionOutput>();
    if (auto apart = checkIsNoInput(options.output, filesOfScene(options.scene, scene)); !apart) return apart.error();
    return MotionOutput::create(options.output, options.fps);
}

// Frames are of a sixtieth of a second, whatever the step.
constexpr double kFrame = 1.0 / 60, kTrial = 1; // s

double msOfFrame(const SimulationReport& report, double dt) { return report.median_ms * kFrame / dt; }

// So long as before, in steps of another length.
void setStep(StagedScene& staged, double dt) {
    brittle::StepDescription& step = staged.scene.step;
    step.steps = static_cast<uint32_t>(std::lround(std::max(1.0, step.steps * step.dt / dt)));
    step.dt = dt;
}

// Prices tell how times compare, not how long this scene takes: its first second is simulated as usual.
Result<AutoReport> pickFor(engine::Device& device, StagedScene& staged, const SimulateOptions& options) {
    const brittle::StepDescription& step = staged.scene.step;
    const double seconds = std::min({kTrial, options.seconds.value_or(kTrial), step.steps * step.dt});
    if (seconds < step.dt)
        return engine::Error{engine::ErrorCode::BadInput,
                             "--budget-ms and --tolerance pick by what a step takes, and so short a "
                             "time has none; give more --seconds"};
    showProgress("measuring the first second");
    const auto usual = simulate(device, staged, seconds, options.group_size, nullptr);
    if (!usual) return usual.error();
    auto picked = pickSetting(device, accuracy::kDynamicsFamily, msOfFrame(*usual, step.dt), options.wish);
    if (!picked) return picked;
    brittle::StepSettings settings{.dt = step.dt};
    applyTo(settings, picked->choice.price);
    setStep(staged, settings.dt);
    staged.adjust = [price = picked->choice.price](brittle::StepSettings& s) { applyTo(s, price); };
    return picked;
}

void print(const SimulateOptions& options, const SimulateOutcome& outcome) {
    if (options.as_json) {
        nlohmann::ordered_json json = {{"device", outcome.device}};
        if (outcome.picked) json["picked"] = autoJson(*outcome.picked);
        json.update(simulationJson(outcome.report));
        std::printf("%s\n", json.dump(2).c_str());
    } else if (options.state_hash) {
        std::printf("%s\n", hexOf(outcome.report.state_hash).c_str());
    } else {
        std::printf("device     %s\n", outcome.device.c_str());
        if (outcome.picked) printAuto(*outcome.picked);
        printSimulation(outcome.report, options.output);
    }
}

Result<void> run(const SimulateOptions& options) {
    auto scene = readSceneOrBuiltin(options.scene);
    if (!scene) return scene.error();
    std::unique_ptr<engine::Device> device; // outlives the output, which may draw with it
    auto output = openOutput(options, *scene);
    if (!output) return output.error();
    showProgress("opening the device");
    auto opened = engine::Device::create({.select = options.device});
    if (!opened) return opened.error();
    device = std::move(*opened);
    auto staged = stageScene(*device, std::move(*scene), {options.scene, options.group_size, !options.output.empty()});
    if (!staged) return staged.error();
    std::optional<AutoReport> picked;
    if (options.wish.isThere()) {
        auto setting = pickFor(*device, *staged, options);
        if (!setting) return setting.error();
        picked = std::move(*setting);
    }
    auto report = simulate(*device, *staged, options.seconds, options.group_size, output->get());
    if (!report) return report.error();
    clearProgress();
    if (picked) picked->taken_ms = msOfFrame(*report, staged->scene.step.dt);
    print(options, {device->name(), std::move(*report), std::move(picked)});
    if (auto printed = checkPrinted(); !printed) return printed;
    return *output ? (*output)->commit() : Result<void>();
}

int runSimulate(const SimulateOptions& options) {
    if (options.output.empty() && !options.as_json && !options.state_hash)
        return fail({ErrorCode::BadInput, "nothing is asked for; give -o, --json or --state-hash"});
    const auto done = run(options);
    return done ? kOk : fail(done.error());
}

constexpr const char* kSimulateFooter =
    "Examples:\n"
    "  brittle simulate card_house -o house.glb\n"
    "  brittle simulate hull_pile_100 -o pile.mp4 --fps 30\n"
    "  brittle simulate window_pane -o pane.png --seconds 0.35\n"
    "  brittle simulate hard_01_block_500 --json\n"
    "  brittle simulate stack_10 --state-hash\n"
    "\n"
    "brittle scenes lists the built-in scenes. A frame between two steps lies evenly between their states. Films need the\n"
    "program ffmpeg.";

} // namespace

void addSimulate(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("simulate", "Let a scene move: write an animation, a picture, a film, or numbers.");
    command->footer(kSimulateFooter);
    auto options = std::make_shared<SimulateOptions>();
    command->add_option("SCENE", options->scene, kSceneHelp)->required();
    auto* output = command->add_option("-o,--output", options->output, kMotionHelp)->check(someText);
    auto* seconds = command->add_option("--seconds", options->seconds,
                                        "how long, rounded up to whole steps; else as many steps as the scene says");
    inRange(seconds, 0, kMostSeconds);
    auto* fps = command->add_option("--fps", options->fps, "frames a second, of animations, numbered pictures and films");
    inRange(fps, kLeastFps, kMostFps)->capture_default_str()->needs(output);
    auto* hash = command->add_flag("--state-hash", options->state_hash,
                                   "print 64 bits that tell the last state of all bodies, and no more");
    command->add_flag("--json", options->as_json, "print one JSON object, the hash in it")->excludes(hash);
    addAutoOptions(*command, options->wish, "a frame of a sixtieth of a second", accuracy::kDynamicsFamily.error);
    addDeviceOptions(*command, options->device, options->group_size, "; the motion is the same");
    command->callback([options, &exit_code] { exit_code = runSimulate(*options); });
}

} // namespace cli
