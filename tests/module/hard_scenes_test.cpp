// Scenes that break rigid-body engines, at the usual settings, none of them tuned for its scene (tests/hard/hard_case.h). What
// each has to fulfill stands with the scene (`brittle scenes NAME`).
#include "tests/engine/test_device.h"
#include "tests/hard/hard_case.h"
#include "tests/support/known_shortfall.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using hard::Check, hard::SceneCase, hard::Trial;

class HardScenes : public testing::TestWithParam<SceneCase> {};

TEST_P(HardScenes, FulfillWhatTheySay) {
    Trial trial(engine_test::device());
    GetParam().measure(trial, GetParam());
    ASSERT_FALSE(trial.failure()) << *trial.failure();
    EXPECT_FALSE(trial.checks().empty());
    for (const Check& check : trial.checks())
        if (check.is_known_shortfall)
            support::knownShortfall(check.what.c_str(), check.value, check.allowed);
        else
            EXPECT_LE(check.value, check.allowed) << check.what << ", " << check.unit;
}

std::vector<SceneCase> casesOf(bool is_long) {
    std::vector<SceneCase> cases;
    std::ranges::copy_if(hard::sceneCases(), std::back_inserter(cases),
                         [&](const SceneCase& c) { return c.is_long == is_long; });
    return cases;
}

std::string nameOf(const testing::TestParamInfo<SceneCase>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Quick, HardScenes, testing::ValuesIn(casesOf(false)), nameOf);
INSTANTIATE_TEST_SUITE_P(Long, HardScenes, testing::ValuesIn(casesOf(true)), nameOf);

} // namespace
