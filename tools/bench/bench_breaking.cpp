// Frames in which bodies break, frame by frame: what the one with the break costs next to those before and after it, and how
// that grows with bodies, with their fragments, and with what else lies about.
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "tools/bench/bench.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace bench {
namespace {

using brittle::BodyDescription;
using brittle::SceneDescription;
using engine::Result;

constexpr uint32_t kFrames = 60;
constexpr double kApart = 1.5; // m, between bodies: fragments of one hardly meet those of another

// Balls of 20 cm that all reach the ground in the same step, so fast that each would break into more than it is allowed to.
BodyDescription fallingBall(uint32_t number, uint32_t columns) {
    BodyDescription body;
    body.shape.kind = brittle::ShapeKind::Ball;
    body.shape.radius = 0.1;
    body.material = "concrete";
    body.place = {kApart * (number % columns), 1.2, kApart * (number / columns)};
    body.velocity = {0, -12, 0};
    return body;
}

// That lie on the ground, a meter from each other, beside all that breaks.
BodyDescription lyingBox(uint32_t number) {
    BodyDescription body;
    body.shape.size = {0.2, 0.2, 0.2};
    body.place = {-2 - 1.0 * (number % 40), 0.1, 1.0 * (number / 40)};
    return body;
}

SceneDescription sceneOf(const BreakingCase& what, const std::vector<std::string>& effects) {
    SceneDescription scene;
    scene.effects = effects;
    scene.colliders.push_back({});
    const auto columns = static_cast<uint32_t>(std::ceil(std::sqrt(what.bodies)));
    for (uint32_t k = 0; k < what.bodies; ++k)
        scene.bodies.push_back(fallingBall(k, columns));
    for (uint32_t k = 0; k < what.bystanders; ++k)
        scene.bodies.push_back(lyingBox(k));
    return scene;
}

Result<std::unique_ptr<brittle::World>> worldOf(engine::Device& device, const BreakingCase& what,
                                                const std::vector<std::string>& effects, uint32_t group_size) {
    const SceneDescription scene = sceneOf(what, effects);
    const auto contents = brittle::contentsOf(scene, ".", nullptr);
    if (!contents) return contents.error();
    const auto settings = brittle::settingsOf(scene);
    if (!settings) return settings.error();
    brittle::WorldBudget budget;
    budget.group_size = group_size;
    budget.breaking.most_fragments = what.cells;
    budget.breaking.step_bodies = what.bodies;
    budget.breaking.step_sites = what.bodies * what.cells;
    budget.breaking.fragments = what.bodies * what.cells + what.bodies * what.cells / 4;
    return brittle::World::create(device, *contents, *settings, budget);
}

struct Frame {
    double ms = 0;
    uint32_t broken = 0, fragments = 0; // in it
};

struct Run {
    std::vector<Frame> frames;
    Times breaking, next; // stages of the frame in which things break first, and of the one after it
};

Result<Times> stagesOf(brittle::World& world) {
    const auto timings = world.timings();
    if (!timings) return timings.error();
    Times stages;
    for (const engine::Timing& timing : *timings)
        stages.emplace_back(timing.name, timing.ms);
    return stages;
}

Result<Frame> runFrame(brittle::World& world, brittle::WorldCounts& before) {
    const auto begin = std::chrono::steady_clock::now();
    if (auto done = world.step(1); !done) return done.error();
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    const auto counts = world.counts();
    if (!counts) return counts.error();
    const Frame frame = {ms, counts->broken - before.broken, counts->fragments - before.fragments};
    before = *counts;
    return frame;
}

Result<Run> runFrames(brittle::World& world) {
    Run run;
    brittle::WorldCounts counts;
    for (uint32_t k = 0; k < kFrames; ++k) {
        const auto frame = runFrame(world, counts);
        if (!frame) return frame.error();
        run.frames.push_back(*frame);
        Times& stages = run.breaking.empty() ? run.breaking : run.next;
        if (counts.broken == 0 || !stages.empty()) continue;
        auto times = stagesOf(world);
        if (!times) return times.error();
        stages = std::move(*times);
    }
    return run;
}

double meanOf(std::vector<Frame>::const_iterator from, std::vector<Frame>::const_iterator to) {
    double sum = 0;
    for (auto frame = from; frame != to; ++frame)
        sum += frame->ms;
    return from == to ? 0 : sum / static_cast<double>(to - from);
}

// The value that so much of all lies below: of the ordered samples the nearest.
double percentileOf(std::vector<double> samples, double share) {
    if (samples.empty()) return 0;
    std::ranges::sort(samples);
    return samples[static_cast<size_t>(std::llround(share * static_cast<double>(samples.size() - 1)))];
}

struct BreakingSamples {
    std::vector<double> all, before, breaking, next, after; // ms
};

void addTo(BreakingSamples& samples, const std::vector<Frame>& frames, BreakingRow& row) {
    const auto first = std::ranges::find_if(frames, [](const Frame& frame) { return frame.broken != 0; });
    for (const Frame& frame : frames)
        samples.all.push_back(frame.ms);
    samples.before.push_back(meanOf(frames.begin(), first));
    if (first == frames.end()) return;
    samples.breaking.push_back(first->ms);
    if (first + 1 != frames.end()) samples.next.push_back((first + 1)->ms);
    samples.after.push_back(meanOf(first + 1, frames.end()));
    row.broken = first->broken;
    row.fragments = first->fragments;
}

// The same sixty frames again and again, from the same state: the first time everything is compiled.
Result<BreakingRow> benchCase(engine::Device& device, const BreakingCase& what, const std::vector<std::string>& effects,
                              const BenchOptions& options) {
    auto world = worldOf(device, what, effects, options.group_size);
    if (!world) return world.error();
    const auto start = (*world)->save();
    if (!start) return start.error();
    BreakingRow row = {what, effects};
    BreakingSamples samples;
    for (uint32_t round = 0; round <= options.rounds; ++round) {
        const auto run = runFrames(**world);
        if (!run) return run.error();
        if (round > 0) addTo(samples, run->frames, row);
        row.stages = run->breaking;
        row.next_stages = run->next;
        if (auto done = (*world)->restore(*start); !done) return done.error();
    }
    row.p50_ms = percentileOf(samples.all, 0.5);
    row.p99_ms = percentileOf(samples.all, 0.99);
    row.before_ms = median(samples.before);
    row.break_ms = median(samples.breaking);
    row.next_ms = median(samples.next);
    row.after_ms = median(samples.after);
    const auto plan = (*world)->plan();
    if (!plan) return plan.error();
    row.bytes = plan->bytes();
    return row;
}

std::string told(const BreakingCase& what) {
    return std::to_string(what.bodies) + " bodies of " + std::to_string(what.cells) + " cells beside " +
           std::to_string(what.bystanders);
}

using Effects = std::vector<std::string>;
const Effects kAll = {"gravity", "contacts", "friction", "impact_fracture", "refracture", "events"};

} // namespace

Result<std::vector<BreakingRow>> benchBreaking(engine::Device& device, const BenchOptions& options, const Progress& progress) {
    std::vector<BreakingRow> rows;
    for (const BreakingCase& what : options.breaking_cases) {
        progress("frames in which things break: " + told(what));
        auto row = benchCase(device, what, kAll, options);
        if (!row) return row.error();
        rows.push_back(std::move(*row));
    }
    return rows;
}

Result<std::vector<BreakingRow>> benchBreakingEffects(engine::Device& device, const BenchOptions& options,
                                                      const Progress& progress) {
    std::vector<BreakingRow> rows;
    if (options.breaking_cases.empty() || !options.effects) return rows;
    const Effects kinds[] = {{"gravity", "contacts", "friction", "ccd"},
                             {"gravity", "contacts", "friction", "impact_fracture"},
                             {"gravity", "contacts", "friction", "impact_fracture", "refracture"},
                             {"gravity", "contacts", "friction", "impact_fracture", "events"},
                             kAll};
    for (const Effects& effects : kinds) {
        progress("what effects cost where things break: " + effects.back());
        auto row = benchCase(device, options.breaking_cases.front(), effects, options);
        if (!row) return row.error();
        rows.push_back(std::move(*row));
    }
    return rows;
}

} // namespace bench
