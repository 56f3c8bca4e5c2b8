// Scenes that something else than a Brittle world moves are judged by the same checks.
#include "tests/engine/test_device.h"
#include "tests/hard/hard_case.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using engine::Error, engine::ErrorCode, engine::Result;
using hard::SceneCase, hard::Trial;

// Lets bodies sink by so many meters, at once and no further.
class SinkingMover : public support::Mover {
public:
    SinkingMover(std::vector<gpu::BodyState> bodies, float depth) : bodies_(std::move(bodies)), depth_(depth) {}
    Result<void> step(uint32_t) override { return {}; }
    Result<std::vector<gpu::BodyState>> bodies() override {
        std::vector<gpu::BodyState> now = bodies_;
        for (gpu::BodyState& body : now)
            if (body.offset.w != 0) body.offset.y -= depth_;
        return now;
    }
    double substep() const override { return 0; }

private:
    std::vector<gpu::BodyState> bodies_;
    float depth_;
};

support::MakeMover sinkingBy(float depth) {
    return [depth](const brittle::SceneDescription&, const brittle::WorldContents& contents) {
        return Result<std::unique_ptr<support::Mover>>(std::make_unique<SinkingMover>(contents.bodies, depth));
    };
}

support::MakeMover failingWith(ErrorCode code) {
    return [code](const brittle::SceneDescription&, const brittle::WorldContents&) {
        return Result<std::unique_ptr<support::Mover>>(Error{code, "not today"});
    };
}

Trial trialOf(const std::string& name, const support::MakeMover& make_mover) {
    Trial trial(engine_test::device(), make_mover);
    const auto found = std::ranges::find(hard::sceneCases(), name, &SceneCase::name);
    EXPECT_TRUE(hard::judgesMotionAlone(*found));
    found->measure(trial, *found);
    return trial;
}

TEST(Movers, AreJudgedByTheChecksOfTheScene) {
    EXPECT_TRUE(trialOf("hard_39_arch_9", sinkingBy(0)).holds());
    const Trial deep = trialOf("hard_39_arch_9", sinkingBy(0.02F));
    EXPECT_FALSE(deep.failure());
    EXPECT_FALSE(deep.holds()) << "a stone may move by 10 mm";
    EXPECT_NEAR(deep.checks()[0].value, 0.02, 1e-6);
}

TEST(Movers, ThatCannotMoveASceneLeaveItOut) {
    const Trial left_out = trialOf("hard_39_arch_9", failingWith(ErrorCode::Feature));
    EXPECT_TRUE(left_out.isLeftOut());
    EXPECT_FALSE(left_out.holds()) << "what was left out has not passed";
    EXPECT_FALSE(trialOf("hard_39_arch_9", failingWith(ErrorCode::Device)).isLeftOut());
}

TEST(Movers, AreNotJudgedByWhatOnlyAWorldTells) {
    for (const char* name : {"hard_32_sleep", "hard_22_far_body", "hard_24_overflow", "hard_42_scales"})
        EXPECT_FALSE(hard::judgesMotionAlone(*std::ranges::find(hard::sceneCases(), std::string(name), &SceneCase::name)));
}

} // namespace
