// Hard cases of motion at a hundredth of their size and at a hundred times their size, judged by their own checks.
#include "tests/engine/test_device.h"
#include "tests/hard/hard_case.h"
#include "tests/support/scaled_mover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

namespace {

using hard::Check, hard::SceneCase, hard::Trial;

constexpr double kScales[] = {0.01, 100};

// Each kind of motion has one case here that takes a few seconds or less.
constexpr std::array<std::string_view, 10> kSoonDone = {
    "hard_34_stack_5_of_5mm", "hard_35_dropped_300",    "hard_36_slide_wedge",         "hard_36_slide_cells",
    "hard_36_slide_sheet",    "hard_37_elastic_tilted", "hard_37_elastic_tumbling_10", "hard_38_cradle_touching",
    "hard_39_arch_9",         "hard_40_compounds_1000"};

// Do not pass yet (docs/long_dynamics.md, "What does not hold yet").
struct Shortfall {
    std::string_view name;
    double scale;
};
constexpr std::array<Shortfall, 6> kShortfalls = {{{"hard_34_stack_5_of_2mm", 0.01},
                                                   {"hard_34_stack_5_of_2mm_10g", 0.01},
                                                   {"hard_34_stack_40_of_2mm", 0.01},
                                                   {"hard_34_stack_40_of_2mm_10g", 0.01},
                                                   {"hard_35_dropped_150_of_10m", 0.01},
                                                   {"hard_43_tiny", 0.01}}};

bool isShortfall(const SceneCase& one, double scale) {
    return std::ranges::any_of(kShortfalls, [&](const Shortfall& s) { return s.name == one.name && s.scale == scale; });
}

void expectShortfall(const Trial& trial) {
    for (const Check& check : trial.checks())
        if (!check.holds())
            std::printf("KNOWN SHORTFALL: %s is %g, allowed are %g\n", check.what.c_str(), check.value, check.allowed);
    EXPECT_FALSE(trial.holds()) << "the case passes now: take it off the list";
}

bool isSoonDone(const SceneCase& one) { return std::ranges::find(kSoonDone, one.name) != kSoonDone.end(); }

using Sized = std::tuple<SceneCase, double>;

class HardScales : public testing::TestWithParam<Sized> {};

TEST_P(HardScales, FulfillWhatTheySay) {
    const auto& [one, scale] = GetParam();
    Trial trial(engine_test::device(), support::scaledMover(engine_test::device(), scale));
    one.measure(trial, one);
    ASSERT_FALSE(trial.failure()) << *trial.failure();
    EXPECT_FALSE(trial.checks().empty());
    if (isShortfall(one, scale)) return expectShortfall(trial);
    for (const Check& check : trial.checks())
        EXPECT_LE(check.value, check.allowed) << check.what << ", " << check.unit << " " << check.body;
}

std::vector<SceneCase> casesOf(bool are_quick) {
    std::vector<SceneCase> cases;
    std::ranges::copy_if(hard::sceneCases(), std::back_inserter(cases),
                         [&](const SceneCase& c) { return hard::judgesMotionAlone(c) && isSoonDone(c) == are_quick; });
    return cases;
}

std::string nameOf(const testing::TestParamInfo<Sized>& info) {
    return std::get<0>(info.param).name + std::string(std::get<1>(info.param) < 1 ? "_small" : "_large");
}

INSTANTIATE_TEST_SUITE_P(Quick, HardScales, testing::Combine(testing::ValuesIn(casesOf(true)), testing::ValuesIn(kScales)),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(Long, HardScales, testing::Combine(testing::ValuesIn(casesOf(false)), testing::ValuesIn(kScales)),
                         nameOf);

} // namespace
