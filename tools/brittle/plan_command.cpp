// brittle plan: what a step of a scene is made of, like a database's EXPLAIN.
#include "modules/brittle/dynamics/scene_settings.h"
#include "tools/brittle/command.h"
#include "tools/brittle/plan_report.h"
#include "tools/brittle/progress.h"
#include "tools/brittle/scene_source.h"
#include "tools/brittle/simulation.h"

#include <cstdio>

namespace cli {
namespace {

using engine::Result;

constexpr uint32_t kMeasuredSteps = 60;

struct PlanOptions {
    std::string scene, device;
    uint32_t group_size = 0;
    bool measure = false;
    bool as_json = false;
};

// What the scene lists, then what that has called for.
Result<std::vector<PlannedEffect>> effectsOf(const brittle::SceneDescription& scene) {
    const auto resolved = brittle::resolve(scene.effects);
    if (!resolved) return resolved.error();
    std::vector<PlannedEffect> effects;
    for (const std::string& name : scene.effects)
        effects.push_back({name, ""});
    for (const brittle::AddedEffect& added : resolved->added)
        effects.push_back({std::string(nameOf(added.effect)), std::string(nameOf(added.called_by))});
    return effects;
}

// Measured first: where pairs run out meanwhile the plan is that of the world with more room.
Result<void> fillPlan(brittle::World& world, bool measure, PlanReport& report) {
    report.is_measured = measure;
    if (measure) {
        showProgress("measuring");
        auto us = world.measure(kMeasuredSteps);
        if (!us) return us.error();
        report.us = std::move(*us);
    }
    auto plan = world.plan();
    if (!plan) return plan.error();
    report.plan = std::move(*plan);
    return {};
}

Result<PlanReport> planOf(const PlanOptions& options) {
    auto scene = readSceneOrBuiltin(options.scene);
    if (!scene) return scene.error();
    auto effects = effectsOf(*scene);
    if (!effects) return effects.error();
    PlanReport report;
    report.effects = std::move(*effects);
    showProgress("opening the device");
    const auto device = engine::Device::create({.select = options.device});
    if (!device) return device.error();
    report.device = (*device)->name();
    const auto staged = stageScene(**device, std::move(*scene), {options.scene, options.group_size});
    if (!staged) return staged.error();
    report.scene = staged->scene.name;
    const auto world = worldOf(**device, *staged, options.group_size);
    if (!world) return world.error();
    if (auto added = fillPlan(**world, options.measure, report); !added) return added.error();
    clearProgress();
    return report;
}

int runPlan(const PlanOptions& options) {
    const auto report = planOf(options);
    if (!report) return fail(report.error());
    if (options.as_json)
        std::printf("%s\n", planJson(*report).dump(2).c_str());
    else
        printPlan(*report);
    return kOk;
}

constexpr const char* kPlanFooter =
    "Examples:\n"
    "  brittle plan card_house\n"
    "  brittle plan hull_pile_100 --measure\n"
    "  brittle plan window_pane --json\n"
    "\n"
    "A pass that comes again in every substep is one line, where it comes first, and its time is that of all of them. Effects\n"
    "that a scene does not call for have no passes and no bytes.";

} // namespace

void addPlan(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand(
        "plan", "Say what a step of a scene is made of: effects, passes, buffers, and what each effect costs.");
    command->footer(kPlanFooter);
    auto options = std::make_shared<PlanOptions>();
    command->add_option("SCENE", options->scene, kSceneHelp)->required();
    command->add_flag("--measure", options->measure, "make 60 steps, and say how long each pass takes (median)");
    command->add_flag("--json", options->as_json, "print one JSON object, with every dispatch");
    addDeviceOptions(*command, options->device, options->group_size, "; the motion is the same");
    command->callback([options, &exit_code] { exit_code = runPlan(*options); });
}

} // namespace cli
