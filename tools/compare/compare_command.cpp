// brittle compare: one scene on two devices, or on this machine and in a recording of another one.
#include "engine/device.h"
#include "tools/brittle/command.h"
#include "tools/brittle/interrupt.h"
#include "tools/brittle/progress.h"
#include "tools/brittle/scene_files.h"
#include "tools/brittle/scene_source.h"
#include "tools/brittle/simulation.h"
#include "tools/compare/compare_report.h"
#include "tools/compare/recording_comparison.h"
#include "tools/compare/scene_hash.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>

namespace cli {
namespace {

using compare::CompareReport;
using compare::MotionRecording;
using engine::Error;
using engine::ErrorCode;
using engine::Result;

constexpr double kMostCompared = 1e6; // steps

struct CompareOptions {
    std::string scene, record, against;
    std::vector<std::string> devices;
    std::optional<uint32_t> steps;
    std::optional<double> seconds;
    uint32_t passes_of = 0; // a step, from 1; 0: none
    uint32_t group_size = 0;
    bool whole = false, as_json = false, fail_on_difference = false;
};

// A device with a world of the scene.
struct OpenedWorld {
    std::unique_ptr<engine::Device> device;
    std::unique_ptr<brittle::World> world;

    brittle::ComparedWorld compared() const { return {*device, *world}; }
    compare::ComparedDevice described() const { return {device->name(), device->driver()}; }
};

Result<std::unique_ptr<engine::Device>> openDevice(const std::string& name) {
    showProgress("opening a device");
    return engine::Device::create({.select = name});
}

Result<OpenedWorld> openWorld(std::unique_ptr<engine::Device> device, const StagedScene& staged, uint32_t group_size) {
    auto world = worldOf(*device, staged, group_size);
    if (!world) return world.error();
    return OpenedWorld{std::move(device), std::move(*world)};
}

Result<void> checkOptions(const CompareOptions& options) {
    const bool has_file = !options.record.empty() || !options.against.empty();
    const size_t wanted = has_file ? 1 : 2;
    if (options.devices.size() == wanted) return {};
    const std::string given = std::to_string(options.devices.size());
    if (has_file)
        return Error{ErrorCode::BadInput, "--device is given " + given + " times; --record and --against take it once"};
    return Error{ErrorCode::BadInput,
                 "--device is given " + given + " times, must be given twice; or use --record and --against on two machines"};
}

Result<uint32_t> stepsOf(const CompareOptions& options, const brittle::StepDescription& step) {
    constexpr double kOnStep = 1e-6; // of a step
    if (options.steps) return *options.steps;
    if (!options.seconds) return step.steps;
    const double steps = std::ceil(*options.seconds / step.dt - kOnStep);
    if (steps > kMostCompared) return Error{ErrorCode::BadInput, "--seconds: more than 1e6 steps; ask for fewer seconds"};
    return static_cast<uint32_t>(std::max(steps, 1.0));
}

brittle::ComparisonOptions comparisonOf(const CompareOptions& options, uint32_t steps) {
    return {steps, options.whole,
            [steps](uint32_t step) { showProgress("step " + std::to_string(step) + " of " + std::to_string(steps)); }};
}

// A scene with its bodies, made on the first device: what differs then is the motion alone.
struct Stage {
    std::unique_ptr<engine::Device> device;
    StagedScene staged;
    uint64_t scene_hash = 0;
    uint32_t steps = 0;
};

uint32_t groupSizeOf(const CompareOptions& options) { return options.group_size == 0 ? GROUP_SIZE : options.group_size; }

Result<Stage> setStage(const CompareOptions& options) {
    auto scene = readSceneOrBuiltin(options.scene);
    if (!scene) return scene.error();
    if (auto apart = checkIsNoInput(options.record, filesOfScene(options.scene, *scene)); !apart) return apart.error();
    Stage stage;
    stage.scene_hash = compare::hashOfScene(*scene, folderOf(options.scene));
    auto device = openDevice(options.devices[0]);
    if (!device) return device.error();
    stage.device = std::move(*device);
    auto staged = stageScene(*stage.device, std::move(*scene), {options.scene, options.group_size});
    if (!staged) return staged.error();
    stage.staged = std::move(*staged);
    const auto steps = stepsOf(options, stage.staged.scene.step);
    if (!steps) return steps.error();
    stage.steps = *steps;
    return stage;
}

CompareReport reportOf(const Stage& stage, compare::ComparedDevice a, compare::ComparedDevice b,
                       brittle::WorldComparison found) {
    clearProgress();
    return {stage.staged.scene.name,     std::move(a),    std::move(b), stage.staged.scene.step.dt,
            stage.staged.contents.names, std::move(found)};
}

Result<CompareReport> compareDevices(const CompareOptions& options) {
    auto stage = setStage(options);
    if (!stage) return stage.error();
    auto second = openDevice(options.devices[1]);
    if (!second) return second.error();
    auto a = openWorld(std::move(stage->device), stage->staged, options.group_size);
    if (!a) return a.error();
    auto b = openWorld(std::move(*second), stage->staged, options.group_size);
    if (!b) return b.error();
    auto found = brittle::compareWorlds(a->compared(), b->compared(), comparisonOf(options, stage->steps));
    if (!found) return found.error();
    return reportOf(*stage, a->described(), b->described(), std::move(*found));
}

Result<void> checkScene(const CompareOptions& options, const Stage& stage, const MotionRecording& recording) {
    const auto differs = [&](const std::string& how) { return Error{ErrorCode::BadInput, options.against + ": " + how}; };
    if (recording.scene != stage.staged.scene.name || recording.dt != stage.staged.scene.step.dt)
        return differs("is a recording of the scene \"" + recording.scene + "\" in steps of " + std::to_string(recording.dt) +
                       " s; compare it with the same scene");
    if (recording.scene_hash != stage.scene_hash)
        return differs("is a recording of another scene with the name \"" + recording.scene +
                       "\": bodies, settings or models differ; compare it with the same scene");
    if (recording.group_size != groupSizeOf(options))
        return differs("was recorded with workgroups of " + std::to_string(recording.group_size) +
                       " lanes; give --group-size " + std::to_string(recording.group_size));
    return {};
}

// Without --steps and --seconds as many steps as were recorded.
Result<CompareReport> compareWithFile(const CompareOptions& options) {
    const auto recording = compare::readRecording(options.against);
    if (!recording) return recording.error();
    auto stage = setStage(options);
    if (!stage) return stage.error();
    if (auto same = checkScene(options, *stage, *recording); !same) return same.error();
    if (!options.steps && !options.seconds) stage->steps = static_cast<uint32_t>(recording->steps.size());
    auto b = openWorld(std::move(stage->device), stage->staged, options.group_size);
    if (!b) return b.error();
    auto found = compare::compareWithRecording(b->compared(), *recording, comparisonOf(options, stage->steps));
    if (!found) return Error{found.error().code, options.against + ": " + found.error().message};
    return reportOf(*stage, {recording->device, recording->driver}, b->described(), std::move(*found));
}

int runComparison(const CompareOptions& options) {
    const auto report = options.against.empty() ? compareDevices(options) : compareWithFile(options);
    if (!report) return fail(report.error());
    if (options.as_json)
        std::printf("%s\n", compareJson(*report).dump(2).c_str());
    else
        printCompare(*report);
    return options.fail_on_difference && !report->agrees() ? kInternalError : kOk;
}

Result<MotionRecording> record(const CompareOptions& options) {
    auto stage = setStage(options);
    if (!stage) return stage.error();
    if (options.passes_of > stage->steps)
        return Error{ErrorCode::BadInput, "--passes-of " + std::to_string(options.passes_of) + ": only " +
                                              std::to_string(stage->steps) + " steps are recorded; give more --steps"};
    auto a = openWorld(std::move(stage->device), stage->staged, options.group_size);
    if (!a) return a.error();
    auto recording =
        compare::recordMotion(a->compared(), {stage->steps, options.passes_of, comparisonOf(options, stage->steps).progress});
    if (!recording) return recording.error();
    recording->scene = stage->staged.scene.name;
    recording->device = a->described().name;
    recording->driver = a->described().driver;
    recording->scene_hash = stage->scene_hash;
    recording->group_size = groupSizeOf(options);
    recording->dt = stage->staged.scene.step.dt;
    return recording;
}

int runRecording(const CompareOptions& options) {
    auto file = createOutput(options.record);
    if (!file) return fail(file.error());
    const auto recording = record(options);
    if (!recording) return fail(recording.error());
    if (auto written = compare::writeRecording(*file, *recording); !written) return fail(written.error());
    clearProgress();
    std::printf("recorded   %zu steps of %s on %s, in %s\n", recording->steps.size(), recording->scene.c_str(),
                recording->device.c_str(), options.record.c_str());
    return kOk;
}

int runCompare(const CompareOptions& options) {
    if (auto sound = checkOptions(options); !sound) return fail(sound.error());
    return options.record.empty() ? runComparison(options) : runRecording(options);
}

constexpr const char* kCompareFooter =
    "Examples:\n"
    "  brittle compare --device 0 --device 1 stack_10\n"
    "  brittle compare --device nvidia --device llvmpipe hull_pile_100 --steps 120 --whole --json\n"
    "  brittle compare --device 0 card_house --record house.motion --passes-of 12\n"
    "  brittle compare --device 0 card_house --against house.motion\n"
    "\n"
    "The same device may be given twice: this checks that it repeats itself. A step is named by its number, from 1.\n"
    "Exit codes: 0 compared, whether the devices agree or not; others as for every command.";

void addComparisonOptions(CLI::App& command, CompareOptions& options) {
    command.add_option("SCENE", options.scene, kSceneHelp)->required();
    command
        .add_option("--device", options.devices,
                    "a part of its name, or its index (see brittle devices); once for device A, again for device B")
        ->required()
        ->allow_extra_args(false)
        ->check(someText);
    auto* steps = command.add_option("--steps", options.steps, "how many steps; else as many as the scene says");
    inRange(steps, 1, kMostCompared);
    auto* seconds = command.add_option("--seconds", options.seconds, "how long, rounded up to whole steps");
    inRange(seconds, 0, 1e6)->excludes(steps)->check([](const std::string& text) {
        return std::strtod(text.c_str(), nullptr) > 0 ? "" : "must be above 0";
    });
    command.add_flag("--whole", options.whole, "make all steps, also after the first difference");
}

void addFileOptions(CLI::App& command, CompareOptions& options) {
    auto* record = command.add_option("--record", options.record, "write the motion on this device to a file");
    auto* against = command.add_option("--against", options.against, "compare with a recorded motion, which is device A");
    record->check(someText)->excludes(against);
    against->check(someText);
    auto* passes = command.add_option("--passes-of", options.passes_of, "record what the passes of this step write as well");
    inRange(passes, 1, kMostCompared)->needs(record);
    for (const char* flag : {"--whole", "--json", "--fail-on-difference"})
        command.get_option(flag)->excludes(record); // a recording compares nothing
}

} // namespace

void addCompare(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("compare", "Step a scene on two devices and say which kernel is the first to compute other values.");
    command->footer(kCompareFooter);
    auto options = std::make_shared<CompareOptions>();
    addComparisonOptions(*command, *options);
    command->add_flag("--json", options->as_json, "print one JSON object");
    command->add_flag("--fail-on-difference", options->fail_on_difference, "exit with 1 if the devices differ");
    addFileOptions(*command, *options);
    addGroupSizeOption(*command, options->group_size, "; the motion is the same");
    command->callback([options, &exit_code] { exit_code = runCompare(*options); });
}

} // namespace cli
