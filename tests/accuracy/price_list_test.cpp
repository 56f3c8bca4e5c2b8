// Which setting the prices of a device call for.
#include "tools/accuracy/price_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace {

using accuracy::Choice, accuracy::Price, accuracy::Wish;

const accuracy::PickedFamily& kFamily = accuracy::kDynamicsFamily;

const std::vector<Price> kPrices = {{"default", "usual", "Nothing.", 1, 24},
                                    {"dt", "1/30 s", "Height.", 0.55, 77},
                                    {"dt", "1/240 s", "Time.", 2.6, 3},
                                    {"axes", "6 fixed", "Directions.", 0.5, 170}};

Choice chosen(const Wish& wish, double usual_ms = 10) {
    const auto choice = accuracy::choose(kPrices, kFamily, usual_ms, wish);
    EXPECT_TRUE(choice) << choice.error().message;
    return choice ? *choice : Choice();
}

TEST(PriceList, ABudgetBuysTheMostAccurateThatKeepsToIt) {
    EXPECT_EQ(chosen({.budget_ms = 30}).price.setting, "1/240 s");
    EXPECT_EQ(chosen({.budget_ms = 11}).price.setting, "usual");
    EXPECT_EQ(chosen({.budget_ms = 6}).price.setting, "1/30 s");
    EXPECT_TRUE(chosen({.budget_ms = 6}).keeps_budget);
    EXPECT_DOUBLE_EQ(chosen({.budget_ms = 6}).expected_ms, 5.5);
}

TEST(PriceList, ABudgetThatNothingKeepsToGetsTheFastestAndSaysSo) {
    const Choice choice = chosen({.budget_ms = 1});
    EXPECT_EQ(choice.price.setting, "6 fixed");
    EXPECT_FALSE(choice.keeps_budget);
    EXPECT_NE(choice.why.find("nothing keeps to 1 ms"), std::string::npos) << choice.why;
}

TEST(PriceList, AToleranceBuysTheFastestWithinIt) {
    EXPECT_EQ(chosen({.tolerance = 100}).price.setting, "1/30 s");
    EXPECT_EQ(chosen({.tolerance = 30}).price.setting, "usual");
    EXPECT_EQ(chosen({.tolerance = 5}).price.setting, "1/240 s");
    EXPECT_EQ(chosen({.budget_ms = 6, .tolerance = 30}).price.setting, "usual") << "errors count more than time";
    EXPECT_FALSE(chosen({.budget_ms = 6, .tolerance = 30}).keeps_budget);
}

TEST(PriceList, AToleranceThatNothingIsWithinIsRefusedWithTheLeastThereIs) {
    const auto choice = accuracy::choose(kPrices, kFamily, 10, {.tolerance = 1});
    ASSERT_FALSE(choice);
    EXPECT_EQ(choice.error().code, engine::ErrorCode::BadInput);
    EXPECT_NE(choice.error().message.find("dt 1/240 s"), std::string::npos) << choice.error().message;
    EXPECT_FALSE(accuracy::choose({}, kFamily, 10, {.budget_ms = 1})) << "no prices at all";
}

accuracy::Results stored() {
    const auto results = accuracy::readResults(std::string(BRITTLE_SOURCE_DIR) + "/tests/cli/accuracy_results.json");
    EXPECT_TRUE(results) << results.error().message;
    return results ? *results : accuracy::Results();
}

bool has(const std::vector<Price>& prices, const std::string& knob) {
    return std::ranges::any_of(prices, [&](const Price& price) { return price.knob == knob; });
}

TEST(PriceList, LeavesOutWhatHadNoResultSomewhereAndWhatIsTheScenes) {
    const auto fracture = accuracy::pricesOf(stored(), accuracy::kFractureFamily);
    ASSERT_FALSE(fracture.empty());
    EXPECT_EQ(fracture.front().knob, "default");
    EXPECT_TRUE(has(fracture, "search") && has(fracture, "caps"));
    EXPECT_FALSE(has(fracture, "precision")) << "ties leave it without a result";
    const auto dynamics = accuracy::pricesOf(stored(), accuracy::kDynamicsFamily);
    EXPECT_TRUE(has(dynamics, "dt") && has(dynamics, "axes"));
    EXPECT_FALSE(has(dynamics, "ccd") || has(dynamics, "sleeping"));
}

TEST(PriceList, AnErrorIsTheWorstOfAllWorkloads) {
    for (const Price& price : accuracy::pricesOf(stored(), accuracy::kFractureFamily))
        if (price.knob == "caps") {
            EXPECT_GT(price.error, 1e-3) << "cut faces are turned over where a model is not convex";
        }
}

TEST(PriceList, LiesInTheCacheByDeviceAndDriver) {
    setenv("XDG_CACHE_HOME", "/somewhere", 1);
    EXPECT_EQ(accuracy::priceListPath("card (9)", "driver 1.2"), "/somewhere/brittle/prices_card_9_driver_1_2.json");
    unsetenv("XDG_CACHE_HOME");
}

} // namespace
