#include "tools/brittle/simulation.h"

#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/mesh/format.h"
#include "tools/brittle/progress.h"
#include "tools/brittle/scene_source.h"
#include "tools/brittle/world_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cli {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;

constexpr double kOnStep = 1e-6, kMostSteps = 1e9;

Result<uint32_t> stepsOf(const brittle::StepDescription& step, std::optional<double> seconds) {
    if (!seconds) return step.steps;
    const double steps = std::ceil(*seconds / step.dt - kOnStep);
    if (steps > kMostSteps)
        return Error{ErrorCode::BadInput, brittle::formatNumber(*seconds) + " s are " + brittle::formatNumber(steps) +
                                              " steps; ask for fewer seconds, 1e9 steps at most"};
    return static_cast<uint32_t>(std::max(steps, *seconds > 0 ? 1.0 : 0.0));
}

Error aboutScene(const StagedScene& staged, const Error& error) {
    const bool is_budget = error.code == ErrorCode::Capacity && error.message.find("budget") != std::string::npos;
    const std::string advice = is_budget ? " (" + staged.room_advice + ")" : "";
    return {error.code, staged.scene.name + ": " + error.message + advice};
}

// What is absent has no mass.
uint32_t moversOf(std::span<const gpu::BodyState> bodies) {
    return static_cast<uint32_t>(std::ranges::count_if(bodies, [](const gpu::BodyState& body) { return body.offset.w > 0; }));
}

class Simulation {
public:
    Simulation(engine::Device& device, StagedScene& staged, brittle::World& world, uint32_t steps)
        : device_(device), staged_(staged), world_(world), steps_(steps),
          clock_(world, staged.surfaces, staged.scene.step.dt, steps) {}

    Result<void> run(MotionOutput* output) {
        if (output != nullptr)
            if (auto shown = show(*output); !shown) return shown;
        if (auto done = clock_.advanceTo(steps_); !done) return aboutScene(staged_, done.error());
        return {};
    }
    Result<SimulationReport> report() const;

private:
    double seconds() const { return steps_ * staged_.scene.step.dt; }
    Result<void> show(MotionOutput& output);
    void addTimes(SimulationReport& report) const;

    engine::Device& device_;
    StagedScene& staged_; // to whose surfaces fragments are added
    brittle::World& world_;
    uint32_t steps_;
    size_t frames_ = 0;
    WorldClock clock_;
};

Result<void> Simulation::show(MotionOutput& output) {
    const Spectacle spectacle = {device_, staged_.scene, staged_.surfaces, brittle::originOf(staged_.contents.bodies)};
    const auto times = output.times(seconds());
    if (!times) return times.error();
    if (auto begun = output.begin(spectacle); !begun) return begun;
    for (const double time : *times) {
        const auto moment = clock_.momentAt(time);
        if (!moment) return aboutScene(staged_, moment.error());
        if (auto added = output.add(time, *moment); !added) return added;
        ++frames_;
    }
    showProgress("writing");
    return output.finish();
}

Result<SimulationReport> Simulation::report() const {
    SimulationReport report;
    report.scene = staged_.scene.name;
    report.steps = steps_;
    report.seconds = seconds();
    report.frames = frames_;
    report.dispatches = world_.dispatches();
    report.counts = {static_cast<uint32_t>(staged_.contents.bodies.size()),
                     static_cast<uint32_t>(staged_.contents.pieces.size())};
    report.movers = moversOf(staged_.contents.bodies);
    report.colliders = report.counts.bodies - report.movers;
    report.pieces = report.counts.pieces;
    report.told = {staged_.scene.step.dt, staged_.contents.names, staged_.contents.materials, clock_.breaks(),
                   clock_.impacts()};
    if (steps_ > 0) {
        const auto counts = world_.counts();
        if (!counts) return counts.error();
        report.counts = *counts;
        addTimes(report);
    }
    const auto bodies = world_.bodies();
    if (!bodies) return bodies.error();
    report.movers_left = moversOf(*bodies);
    report.kinetic_energy = brittle::kineticEnergyOf(*bodies);
    if (const auto settings = brittle::settingsOf(staged_.scene); settings && settings->dust) {
        auto dust = world_.dust();
        if (!dust) return dust.error();
        report.dust = std::move(*dust);
    }
    const auto hash = world_.hash();
    if (!hash) return hash.error();
    report.state_hash = *hash;
    return report;
}

void Simulation::addTimes(SimulationReport& report) const {
    std::vector<double> ms = clock_.stepTimes();
    report.first_ms = ms.front();
    if (ms.size() > 1) ms.erase(ms.begin());
    std::ranges::sort(ms);
    const auto at = [&](double share) {
        return ms[static_cast<size_t>(std::lround(share * static_cast<double>(ms.size() - 1)))];
    };
    report.median_ms = at(0.5);
    report.p99_ms = at(0.99);
    double all = 0;
    for (const auto& [name, stage_ms] : clock_.stages())
        all += stage_ms;
    for (const auto& [name, stage_ms] : clock_.stages())
        report.shares.emplace_back(name, all > 0 ? stage_ms / all : 0);
}

} // namespace

Result<StagedScene> stageScene(engine::Device& device, brittle::SceneDescription scene, const Staging& staging) {
    StagedScene staged;
    staged.scene = std::move(scene);
    if (staged.scene.name.empty()) staged.scene.name = staging.source;
    const auto fracture = brittle::fractureFor(staged.scene, device, staging.group_size);
    if (!fracture) return fracture.error();
    showProgress("making the bodies");
    auto contents = brittle::contentsOf(staged.scene, folderOf(staging.source), fracture->get(),
                                        staging.has_surfaces ? &staged.surfaces : nullptr);
    if (!contents) return Error{contents.error().code, staged.scene.name + ": " + contents.error().message};
    staged.contents = std::move(*contents);
    if (!staged.contents.reader_notes.empty()) clearProgress();
    for (const std::string& note : staged.contents.reader_notes)
        std::fprintf(stderr, "brittle: %s\n", note.c_str());
    return staged;
}

Result<std::unique_ptr<brittle::World>> worldOf(engine::Device& device, const StagedScene& staged, uint32_t group_size) {
    auto settings = brittle::settingsOf(staged.scene);
    if (!settings) return aboutScene(staged, settings.error());
    if (staged.adjust) staged.adjust(*settings);
    auto world = brittle::World::create(device, staged.contents, *settings, brittle::budgetOf(staged.scene, group_size));
    if (!world) return aboutScene(staged, world.error());
    return world;
}

Result<SimulationReport> simulate(engine::Device& device, StagedScene& staged, std::optional<double> seconds,
                                  uint32_t group_size, MotionOutput* output) {
    const auto steps = stepsOf(staged.scene.step, seconds);
    if (!steps) return steps.error();
    const auto world = worldOf(device, staged, group_size);
    if (!world) return world.error();
    Simulation simulation(device, staged, **world, *steps);
    if (auto done = simulation.run(output); !done) return done.error();
    return simulation.report();
}

std::string hexOf(uint64_t hash) {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
    return digits;
}

namespace {

nlohmann::ordered_json dustJson(const brittle::Dust& dust) {
    const auto json = [](const brittle::DustAmount& amount) {
        return nlohmann::ordered_json{{"particles", amount.particles}, {"mass", amount.mass}};
    };
    return {{"made", json(dust.made)},
            {"flying", json(dust.inTheAir())},
            {"settled", json(dust.settled)},
            {"overwritten", json(dust.overwritten)}};
}

void printDust(const brittle::Dust& dust) {
    std::printf("dust       %llu particles, %s kg; %llu at the end, %s kg\n",
                static_cast<unsigned long long>(dust.made.particles), brittle::formatNumber(dust.made.mass).c_str(),
                static_cast<unsigned long long>(dust.flying.size()), brittle::formatNumber(dust.inTheAir().mass).c_str());
    if (dust.overwritten.particles > 0)
        std::printf("           %llu had to make room for others, %s kg; raise the budget of dust\n",
                    static_cast<unsigned long long>(dust.overwritten.particles),
                    brittle::formatNumber(dust.overwritten.mass).c_str());
}

} // namespace

nlohmann::ordered_json simulationJson(const SimulationReport& r) {
    nlohmann::ordered_json shares = nlohmann::ordered_json::object();
    for (const auto& [name, share] : r.shares)
        shares[name] = share;
    return {{"scene", r.scene},
            {"seconds", r.seconds},
            {"steps", r.steps},
            {"frames", r.frames},
            {"ms_per_step", {{"median", r.median_ms}, {"p99", r.p99_ms}, {"first", r.first_ms}}},
            {"dispatches_per_step", r.dispatches},
            {"bodies", r.movers},
            {"bodies_at_end", r.movers_left},
            {"broken", r.counts.broken},
            {"fragments", r.counts.fragments},
            {"breaks", breaksJson(r.told)},
            {"breaks_lost", r.told.breaks.lost},
            {"impacts", impactsJson(r.told)},
            {"impacts_lost", r.told.impacts.lost},
            {"expired", r.counts.expired},
            {"gone", goneJson(r.told)},
            {"dust", r.dust ? dustJson(*r.dust) : nlohmann::ordered_json()},
            {"colliders", r.colliders},
            {"pieces", r.pieces},
            {"pairs", r.counts.pairs},
            {"contacts", r.counts.contacts},
            {"awake", r.counts.awake},
            {"stages", shares},
            {"kinetic_energy", r.kinetic_energy},
            {"state_hash", hexOf(r.state_hash)}};
}

void printSimulation(const SimulationReport& r, const std::string& output) {
    std::printf("scene      %s: %u bodies and %u colliders, of %u pieces\n", r.scene.c_str(), r.movers, r.colliders, r.pieces);
    std::printf("steps      %u, %s s; at the last %u pairs, %u contacts, %u bodies awake, %s J of motion\n", r.steps,
                brittle::formatNumber(r.seconds).c_str(), r.counts.pairs, r.counts.contacts, r.counts.awake,
                brittle::formatNumber(r.kinetic_energy).c_str());
    if (r.counts.broken > 0)
        std::printf("broken     %u bodies, into %u fragments; %u bodies at the end\n", r.counts.broken, r.counts.fragments,
                    r.movers_left);
    printEvents(r.told);
    if (r.counts.expired > 0) std::printf("gone       %u fragments, after their time or to make room\n", r.counts.expired);
    if (r.dust) printDust(*r.dust);
    std::printf("time       %.2f ms a step (median), %.2f (99 of 100), %.0f the first; %u dispatches\n", r.median_ms, r.p99_ms,
                r.first_ms, r.dispatches);
    for (const auto& [name, share] : r.shares)
        std::printf("  %-22s %9.1f %%\n", name.c_str(), 100 * share);
    std::printf("state      %s\n", hexOf(r.state_hash).c_str());
    if (!output.empty()) std::printf("written    %zu frames, in %s\n", r.frames, output.c_str());
}

} // namespace cli
