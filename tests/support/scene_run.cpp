#include "tests/support/scene_run.h"

#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/engine/test_device.h"

#include <gtest/gtest.h>

namespace support {
namespace {

brittle::SceneDescription builtin(const std::string& name) {
    auto scene = brittle::makeBuiltinScene(name);
    if (!scene) ADD_FAILURE() << scene.error().message;
    return scene ? *scene : brittle::SceneDescription();
}

} // namespace

SceneRun::SceneRun(const std::string& name) : SceneRun(builtin(name)) {}

SceneRun::SceneRun(const brittle::SceneDescription& scene) : MeasuredScene(scene) {
    const auto made = make(engine_test::device());
    EXPECT_TRUE(made) << made.error().message;
    is_there_ = static_cast<bool>(made);
}

void SceneRun::step(uint32_t steps) {
    ASSERT_TRUE(is_there_);
    const auto done = advance(steps);
    ASSERT_TRUE(done) << done.error().message;
}

} // namespace support
