// Pairs of pieces whose boxes meet, the points where they touch, and what is remembered of them from step to step.
#include "modules/brittle/dynamics/step.h"
#include "modules/brittle/mesh/vector_math.h"
#include "shaders-spirv/shared/sweep.h"

#include <algorithm>
#include <numbers>

namespace brittle {
namespace {

constexpr Length kBoxPairs = {0, COUNT_BOX_PAIRS};

float sweptFor(const Step& s) { return static_cast<float>(SWEEP_AHEAD * s.settings.dt); }

// How deep what rests on something else sinks in, four times: a contact is a spring of `contact_hertz`.
float stripOf(const Step& s) {
    constexpr double kTimes = 4, kLeast = 1e-6; // m
    const Double3& g = s.settings.gravity;
    const double omega = 2 * std::numbers::pi * contactHertz(s.settings);
    return static_cast<float>(std::max(kTimes * length(g) / (omega * omega), kLeast));
}

BroadPhase broadPhaseOf(const Step& s) {
    const StepBuffers& b = s.b.step;
    return {s.b.broad_phase, b.broad_phase, b.box_low, b.box_high, s.now.pairs};
}

// Pairs whose points are to be found: all that were not near each other, or have moved against each other since.
void recordRecall(const Step& s) {
    const StepBuffers& b = s.b.step;
    const auto& r = s.record;
    const Float3 g = toFloat(s.settings.gravity);
    struct Push {
        float gravity[4], speculative;
        uint32_t recycling;
    } push = {{g[0], g[1], g[2], sweptFor(s)}, static_cast<float>(contactMargin(s.settings)), s.settings.recycling ? 1u : 0u};
    s.record.run(
        "recall_contacts", kBoxPairs, push,
        {r.counts(), s.now.pairs, s.last.count, s.last.pairs, s.last.contacts, s.b.bodies, s.b.shapes, b.recalled, b.fresh});
    s.record.scan(kBoxPairs, b.fresh, b.sums, b.fresh_slots,
                  {{COUNT_FRESH_PAIRS, NO_INDEX, NO_INDEX, NO_INDEX}, {s.b.sizes.pairs, 0, 0, 0}});
    s.record.run("list_fresh", kBoxPairs, engine::NoPush{}, {r.counts(), s.now.pairs, b.fresh_slots, b.fresh_pairs});
}

engine::Result<void> recordFreshPoints(const Step& s) {
    NarrowPhaseInput input = {s.b.hulls(),       s.b.pieces,        s.b.bodies,     s.b.step.fresh_pairs,
                              s.record.counts(), COUNT_FRESH_PAIRS, s.b.sizes.pairs};
    input.first_hits = s.b.step.first_hits;
    if (s.has(Effect::ImpactFracture)) input.siblings = {s.b.births, s.b.steps};
    return recordPoints(s, input, toFloat(s.settings.gravity));
}

void recordMemory(const Step& s) {
    const StepBuffers& b = s.b.step;
    s.record.run("remember_contacts", kBoxPairs, engine::NoPush{},
                 {s.record.counts(), b.recalled, b.fresh_slots, b.manifolds, s.last.contacts, s.b.bodies, s.b.shapes,
                  s.now.contacts, b.touches});
    s.record.runGroups("keep_pair_count", s.record.groupsOf(COUNT_ONCE), engine::NoPush{}, {s.record.counts(), s.now.count});
}

void recordPieceBoxes(const Step& s) {
    struct Push {
        float gravity[4];
        float margin;
    } push = {{0, 0, 0, static_cast<float>(s.settings.dt)}, static_cast<float>(contactMargin(s.settings) / 2)};
    s.record.run(
        "bound_pieces", Length::counted(COUNT_BOXES), push,
        {s.record.counts(), s.b.pieces, s.b.bodies, s.b.hull_records, s.b.hull_vertices, s.b.step.box_low, s.b.step.box_high});
}

} // namespace

void recordBoxes(const Step& s) {
    s.record.commands().beginLabel("boxes");
    s.record.runGroups("open_step", 1, engine::NoPush{}, {s.record.counts(), s.record.args(), s.b.steps});
    const gpu::vec4 falling = fallingOf(s);
    const float push[] = {falling.x, falling.y, falling.z, falling.w, 0.5f * solverPush(s).gravity.w};
    s.record.run("begin_step", Length::counted(COUNT_BODIES), push,
                 {s.record.counts(), s.b.bodies, s.b.shapes, s.b.step.solver_bodies, s.b.step.spins, s.b.step.shares, s.b.steps,
                  s.b.step.parents, s.b.step.first_hits});
    if (s.has(Effect::Contacts)) recordPieceBoxes(s);
    s.record.commands().endLabel();
}

engine::Result<void> recordPoints(const Step& s, const NarrowPhaseInput& input, const Float3& gravity) {
    const StepBuffers& b = s.b.step;
    NarrowPhaseOptions options;
    options.speculative = static_cast<float>(contactMargin(s.settings));
    options.duration = sweptFor(s);
    options.gravity = gravity;
    options.fixed_axes = s.settings.fixed_axes;
    options.step = static_cast<float>(s.settings.dt);
    options.strip = stripOf(s);
    return recordNarrowPhase(s.record.commands(), s.kernels, input, options, {b.manifolds, b.axes, b.narrow_arguments},
                             s.many_lanes);
}

engine::Result<void> recordContacts(const Step& s) {
    if (!s.has(Effect::Contacts)) return {};
    recordBroadPhase(s.record, broadPhaseOf(s));
    s.record.commands().beginLabel("narrow_phase");
    recordRecall(s);
    if (auto recorded = recordFreshPoints(s); !recorded) return recorded;
    recordMemory(s);
    s.record.commands().endLabel();
    return {};
}

} // namespace brittle
