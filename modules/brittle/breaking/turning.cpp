#include "modules/brittle/breaking/turning.h"

namespace brittle {
namespace {

constexpr uint32_t kAttempts = 4; // near the meeting each squares what is left of the error
constexpr Length kTurning = {0, COUNT_TURNING};

void recordPoses(const Step& s, const LastingBuffers& l, const PassingBuffers& p, bool is_first) {
    const StepBuffers& b = s.b.step;
    const struct {
        MeetingPush meeting;
        uint32_t is_first;
    } push = {meetingPush(s), is_first ? 1u : 0u};
    s.record.run("advance_turning", kTurning, push,
                 {s.record.counts(), s.now.pairs, s.b.bodies, s.b.shapes, b.solver_bodies, s.b.pieces, b.manifolds, p.turning,
                  p.posed_bodies, p.posed_pieces, p.posed_pairs, b.axes, l.breakable, l.cards, s.b.steps});
}

// Gravity is in the speeds that the poses have.
engine::Result<void> recordPosedPoints(const Step& s, const PassingBuffers& p) {
    return recordPoints(
        s, {s.b.hulls(), p.posed_pieces, p.posed_bodies, p.posed_pairs, s.record.counts(), COUNT_TURNING, s.b.sizes.pairs},
        {0, 0, 0});
}

} // namespace

MeetingPush meetingPush(const Step& s) {
    const gpu::vec4 g = solverPush(s).gravity;
    return {{g.x, g.y, g.z, g.w}, static_cast<float>(s.settings.dt)};
}

engine::Result<void> recordTurning(const Step& s, const LastingBuffers& l, const PassingBuffers& p) {
    s.record.publish(COUNT_TURNING, NO_INDEX);
    for (uint32_t k = 0; k < kAttempts; ++k) {
        recordPoses(s, l, p, k == 0);
        if (auto recorded = recordPosedPoints(s, p); !recorded) return recorded;
    }
    const struct {
        MeetingPush meeting;
        float margin;
    } push = {meetingPush(s), static_cast<float>(contactMargin(s.settings))};
    s.record.run("judge_turning", kTurning, push,
                 {s.record.counts(), p.turning, s.b.step.manifolds, s.b.bodies, s.b.shapes, s.b.step.solver_bodies, l.breakable,
                  l.cards, s.b.steps, p.blows, s.now.contacts, s.b.step.touches});
    return {};
}

} // namespace brittle
