#include "modules/brittle/breaking/turning.h"

#include "modules/brittle/mesh/vector_math.h"
#include "shaders-spirv/shared/sweep.h"

namespace brittle {
namespace {

constexpr uint32_t kAttempts = 3; // each squares what is left of the error
constexpr Length kTurning = {0, COUNT_TURNING};

void recordPoses(const Step& s, const PassingBuffers& p, bool is_first) {
    const StepBuffers& b = s.b.step;
    const gpu::vec4 g = solverPush(s).gravity;
    const struct {
        float gravity[4], duration;
        uint32_t is_first;
    } push = {{g.x, g.y, g.z, g.w}, static_cast<float>(s.settings.dt), is_first ? 1u : 0u};
    s.record.run("advance_turning", kTurning, push,
                 {s.record.counts(), s.now.pairs, s.b.bodies, s.b.shapes, b.solver_bodies, s.b.pieces, b.manifolds, p.turning,
                  p.posed_bodies, p.posed_pieces, p.posed_pairs, b.axes});
}

// Gravity is in the speeds that the poses have.
engine::Result<void> recordPoints(const Step& s, const PassingBuffers& p) {
    const StepBuffers& b = s.b.step;
    const NarrowPhaseInput input = {
        s.b.hulls(),    p.posed_pieces, p.posed_bodies, p.posed_pairs, s.record.counts().sub(4 * COUNT_TURNING, 4),
        s.b.sizes.pairs};
    NarrowPhaseOptions options;
    options.speculative = static_cast<float>(s.settings.margin);
    options.duration = static_cast<float>(SWEEP_AHEAD * s.settings.dt);
    options.gravity = {0, 0, 0};
    options.fixed_axes = s.settings.fixed_axes;
    return recordNarrowPhase(s.record.commands(), s.kernels, input, options, {b.manifolds, b.axes, b.narrow_arguments},
                             s.many_lanes);
}

} // namespace

engine::Result<void> recordTurning(const Step& s, const LastingBuffers& l, const PassingBuffers& p) {
    s.record.publish(COUNT_TURNING, NO_INDEX);
    for (uint32_t k = 0; k < kAttempts; ++k) {
        recordPoses(s, p, k == 0);
        if (auto recorded = recordPoints(s, p); !recorded) return recorded;
    }
    const gpu::vec4 gravity = solverPush(s).gravity;
    const float judge[] = {gravity.x, gravity.y, gravity.z, gravity.w, static_cast<float>(s.settings.dt)};
    s.record.run("judge_turning", kTurning, judge,
                 {s.record.counts(), p.turning, s.b.step.manifolds, s.b.bodies, s.b.shapes, s.b.step.solver_bodies, l.breakable,
                  l.cards, s.b.steps, p.blows, p.hardest});
    return {};
}

} // namespace brittle
