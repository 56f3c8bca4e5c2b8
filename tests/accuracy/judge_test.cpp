// What is made of measurements: medians, which settings are dominated, and the lines that are told.
#include "tools/accuracy/judge.h"

#include <gtest/gtest.h>

namespace {

using accuracy::judge;
using accuracy::Measurement;
using accuracy::Results;
using accuracy::samplesOf;

Measurement measured(const std::string& setting, std::vector<double> ms, double error, double resolution = 0.001) {
    Measurement m;
    m.workload = "heap";
    m.knob = setting == "usual" ? "default" : "knob";
    m.setting = setting;
    m.is_default = setting == "usual";
    m.ms = samplesOf(std::move(ms));
    m.errors = {{"depth", error, resolution}};
    return m;
}

Results judged(std::vector<Measurement> measurements) {
    Results results;
    results.kinds = {{"depth", "depth of overlaps", "mm", "closed form"}};
    results.workloads = {{"heap", "dynamics", "A heap", "a step", "of the world", {"depth"}}};
    results.measurements = std::move(measurements);
    judge(results);
    return results;
}

bool isDominated(const Results& results, const std::string& setting) {
    for (const Measurement& m : results.measurements)
        if (m.setting == setting) return m.is_dominated;
    ADD_FAILURE() << setting;
    return false;
}

std::vector<std::string> linesOf(const Results& results) {
    std::vector<std::string> settings;
    for (const accuracy::UsefulLine& line : results.useful)
        settings.push_back(results.measurements[line.measurement].setting);
    return settings;
}

TEST(Samples, HaveTheirMedianBetweenTheirQuartiles) {
    const accuracy::Samples samples = samplesOf({9, 1, 5, 3, 7});
    EXPECT_EQ(samples.median, 5);
    EXPECT_EQ(samples.low, 3);
    EXPECT_EQ(samples.high, 7);
    EXPECT_EQ(samples.raw.front(), 9);
    EXPECT_EQ(samplesOf({2, 4}).median, 3);
    EXPECT_EQ(samplesOf({}).median, 0);
}

TEST(ShortNumber, HasThreeDigitsThatCount) {
    EXPECT_EQ(accuracy::shortNumber(0), "0");
    EXPECT_EQ(accuracy::shortNumber(12345.6), "12346");
    EXPECT_EQ(accuracy::shortNumber(1000), "1000");
    EXPECT_EQ(accuracy::shortNumber(12.34), "12.3");
    EXPECT_EQ(accuracy::shortNumber(0.5), "0.5");
    EXPECT_EQ(accuracy::shortNumber(0.001234), "0.00123");
    EXPECT_EQ(accuracy::shortNumber(1.25e-8), "1.2e-08");
}

TEST(Judge, FindsASettingDominatedByOneThatIsFasterAndBetter) {
    const Results results = judged({measured("usual", {10, 10, 10}, 5), measured("slow", {20, 20, 20}, 6),
                                    measured("fine", {20, 20, 20}, 1), measured("coarse", {5, 5, 5}, 9)});
    EXPECT_FALSE(isDominated(results, "usual"));
    EXPECT_TRUE(isDominated(results, "slow"));
    EXPECT_FALSE(isDominated(results, "fine"));
    EXPECT_FALSE(isDominated(results, "coarse"));
    EXPECT_DOUBLE_EQ(results.measurements[1].times_default, 2);
}

TEST(Judge, LetsNoiseDominateNothing) {
    EXPECT_FALSE(isDominated(judged({measured("usual", {8, 10, 12}, 5), measured("same", {9, 11, 13}, 5)}), "same"));
    EXPECT_TRUE(isDominated(judged({measured("usual", {8, 9, 10}, 5), measured("same", {11, 12, 13}, 5)}), "same"));
}

TEST(Judge, TakesAllBelowTheResolutionForTheSame) {
    const Results results = judged({measured("usual", {10, 10, 10}, 0.0009), measured("other", {20, 20, 20}, 1e-17)});
    EXPECT_TRUE(isDominated(results, "other"));
}

TEST(Judge, HasNothingToSayOfSettingsWithoutAResult) {
    Measurement failed = measured("broken", {}, 0);
    failed.errors.clear();
    failed.failed = "signs that contradict each other";
    const Results results = judged({measured("usual", {10, 10, 10}, 5), failed});
    EXPECT_FALSE(isDominated(results, "broken"));
    EXPECT_FALSE(isDominated(results, "usual"));
    EXPECT_TRUE(results.useful.empty());
}

TEST(Judge, TellsWhatSavesTimeForNothingForSomethingAndWhatBuysAccuracy) {
    const Results results = judged({measured("usual", {10, 10, 10}, 5), measured("free", {8, 8, 8}, 5),
                                    measured("rough", {4, 4, 4}, 6), measured("fine", {15, 15, 15}, 1)});
    EXPECT_EQ(linesOf(results), (std::vector<std::string>{"free", "rough", "fine"}));
    EXPECT_NE(results.useful[2].text.find("1 mm instead of 5 mm"), std::string::npos) << results.useful[2].text;
    EXPECT_NE(results.useful[2].text.find("1.5 times"), std::string::npos) << results.useful[2].text;
}

TEST(Judge, TellsOfTheWorkloadThatStandsForItsFamily) {
    Results results = judged({measured("usual", {10, 10, 10}, 5), measured("rough", {4, 4, 4}, 6)});
    results.workloads.push_back(results.workloads.front());
    results.workloads.back().name = "pebble";
    for (Measurement m : {measured("usual", {10, 10, 10}, 5), measured("finer", {10, 10, 10}, 1)}) {
        m.workload = "pebble";
        results.measurements.push_back(m);
    }
    judge(results);
    EXPECT_EQ(linesOf(results), std::vector<std::string>{"rough"});
    results.workloads.back().family = "another";
    judge(results);
    EXPECT_EQ(linesOf(results), (std::vector<std::string>{"rough", "finer"}));
}

TEST(Judge, SavesNoTimeWhereNotEveryRunWasFaster) {
    EXPECT_TRUE(judged({measured("usual", {8, 10, 12}, 5), measured("free", {5, 6, 8.5}, 5)}).useful.empty());
}

} // namespace
