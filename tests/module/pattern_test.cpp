// Where the patterns place sites.
#include "tests/module/whole_fracture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using brittle::Double3;
using brittle::Pattern;

std::vector<Double3> sitesOf(const std::string& name, const brittle::FractureOptions& asked) {
    const whole::Model model = whole::modelFrom(name);
    brittle::FractureOptions options = asked;
    options.only_cells = true;
    const auto result = whole::fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
    EXPECT_TRUE(result) << result.error().message;
    return result ? result->sites : std::vector<Double3>();
}

double distance(const Double3& a, const Double3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

double meanDistance(const std::vector<Double3>& sites, const Double3& place) {
    double sum = 0;
    for (const Double3& s : sites)
        sum += distance(s, place);
    return sum / static_cast<double>(sites.size());
}

// In a cube from -1/2 to 1/2, hit in the middle, the pattern is whole up to r = 1/2.
TEST(ImpactPattern, IsEvenWithinTheContactRadiusAndFallsWithTheFourthPowerOutside) {
    brittle::FractureOptions options;
    options.site_count = 6000;
    options.pattern = Pattern::Impact;
    options.impact.contact_radius = 0.05;
    const std::vector<Double3> sites = sitesOf("builtin:cube", options);
    std::vector<double> radii;
    for (const Double3& s : sites)
        if (distance(s, {0, 0, 0}) < 0.5) radii.push_back(distance(s, {0, 0, 0}));
    ASSERT_GT(radii.size(), 5000u);
    const auto cumulated = [](double r) { return r < 0.05 ? std::pow(r / 0.05, 3) / 3 : 4.0 / 3 - 0.05 / r; };
    const double n = static_cast<double>(radii.size());
    for (const double r : {0.02, 0.03, 0.05, 0.07, 0.1, 0.2, 0.35}) {
        const double expected = cumulated(r) / cumulated(0.5);
        const double found =
            static_cast<double>(std::count_if(radii.begin(), radii.end(), [r](double x) { return x < r; })) / n;
        EXPECT_NEAR(found, expected, 3.5 * std::sqrt(expected * (1 - expected) / n)) << "within " << r;
    }
}

TEST(ImpactPattern, HasNoPreferredDirection) {
    brittle::FractureOptions options;
    options.site_count = 4000;
    options.pattern = Pattern::Impact;
    options.impact.contact_radius = 0.05;
    Double3 mean = {0, 0, 0};
    std::array<uint32_t, 8> octants{};
    for (const Double3& s : sitesOf("builtin:cube", options)) {
        for (size_t k = 0; k < 3; ++k)
            mean[k] += s[k] / distance(s, {0, 0, 0}) / 4000;
        ++octants[(s[0] > 0 ? 1u : 0u) + (s[1] > 0 ? 2u : 0u) + (s[2] > 0 ? 4u : 0u)];
    }
    for (const double x : mean)
        EXPECT_NEAR(x, 0, 3.5 * std::sqrt(1.0 / 3 / 4000));
    for (const uint32_t count : octants)
        EXPECT_NEAR(count, 500, 3.5 * std::sqrt(500 * 7 / 8.0));
}

TEST(ImpactPattern, ReachesAllOfAModelThatIsHitHard) {
    brittle::FractureOptions options;
    options.site_count = 500;
    options.pattern = Pattern::Impact;
    options.impact = {{0.5, 0.5, 0.5}, 100, 1};
    const std::vector<Double3> sites = sitesOf("builtin:cube", options);
    EXPECT_EQ(sites.size(), 500u);
    // A radius of all distances fills the cube evenly: the mean distance between a corner and the rest of it is 0.96.
    EXPECT_NEAR(meanDistance(sites, {0.5, 0.5, 0.5}), 0.9606, 0.05);
}

TEST(ImpactPattern, PlacesSitesInAThinRingThatIsHitFromFarAway) {
    brittle::FractureOptions options;
    options.site_count = 200;
    options.pattern = Pattern::Impact;
    options.impact = {{8, 0, 0}, 1e-6, 1};
    EXPECT_EQ(sitesOf("builtin:ring", options).size(), 200u);
}

TEST(PaperPattern, DrawsSitesToTheImpactAsOftenAsItsStrengthSays) {
    brittle::FractureOptions options;
    options.site_count = 1000;
    options.pattern = Pattern::Paper;
    options.impact.place = {0.5, 0.5, 0.5};
    std::vector<double> means;
    for (const double favor : {0.0, 0.5, 1.0}) {
        options.impact.favor = favor;
        const std::vector<Double3> sites = sitesOf("builtin:cube", options);
        EXPECT_GT(sites.size(), 990u);
        means.push_back(meanDistance(sites, {0.5, 0.5, 0.5}));
    }
    EXPECT_NEAR(means[1], (means[0] + means[2]) / 2, 0.02);
    EXPECT_LT(means[2], means[0] - 0.3);
}

// Without an impact a site is r3 = s + u3 (r2 - s), with r2 on a triangle of the surface and s the center of the box: half of
// all lie in the half of the way, along any ray from the center.
TEST(PaperPattern, InterpolatesEvenlyBetweenTheCenterAndTheSurface) {
    brittle::FractureOptions options;
    options.site_count = 4000;
    options.pattern = Pattern::Paper;
    const std::vector<Double3> sites = sitesOf("builtin:cube", options);
    const double n = static_cast<double>(sites.size());
    for (const double share : {0.1, 0.25, 0.5, 0.75, 0.9}) {
        const auto nearer = [share](const Double3& s) {
            return 2 * std::max({std::fabs(s[0]), std::fabs(s[1]), std::fabs(s[2])}) < share;
        };
        EXPECT_NEAR(static_cast<double>(std::count_if(sites.begin(), sites.end(), nearer)) / n, share,
                    3.5 * std::sqrt(share * (1 - share) / n));
    }
}

// How much of the way from the center to the surface of the unit cube, drawn evenly, lies within the radius.
double shareWithin(double radius) {
    constexpr int kSteps = 64;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j)
            sum += std::min(1.0, radius / std::hypot(0.5, (i + 0.5) / kSteps - 0.5, (j + 0.5) / kSteps - 0.5));
    return sum / (kSteps * kSteps);
}

// Of a hit in the center the nearest of n candidates lies within r as often as not all n lie outside of it.
TEST(PaperPattern, TakesTheNearestOfAsManyCandidatesAsAreAskedFor) {
    for (const uint32_t candidates : {1u, 3u, 8u, 100u, 256u}) {
        brittle::FractureOptions options;
        options.site_count = 2000;
        options.pattern = Pattern::Paper;
        options.impact.favor = 1;
        options.impact.candidates = candidates;
        const std::vector<Double3> sites = sitesOf("builtin:cube", options);
        const double n = static_cast<double>(sites.size());
        EXPECT_GT(n, 1900) << candidates;
        for (const double radius : {0.002, 0.01, 0.05, 0.1, 0.2, 0.4}) {
            const auto is_within = [radius](const Double3& s) { return distance(s, {0, 0, 0}) < radius; };
            const double expected = 1 - std::pow(1 - shareWithin(radius), candidates);
            EXPECT_NEAR(static_cast<double>(std::count_if(sites.begin(), sites.end(), is_within)) / n, expected,
                        3.5 * std::sqrt(expected * (1 - expected) / n) + 1e-12)
                << candidates << " candidates, radius " << radius;
        }
    }
}

TEST(PaperPattern, RefusesNoCandidatesAndMoreThanAGroupDraws) {
    const whole::Model cube = whole::modelFrom("builtin:cube");
    for (const uint32_t candidates : {0u, 257u}) {
        brittle::FractureOptions options;
        options.pattern = Pattern::Paper;
        options.impact.candidates = candidates;
        const auto broken = whole::fracture().shatter(cube.prepared.mesh, cube.prepared.topology, options);
        ASSERT_FALSE(broken);
        EXPECT_NE(broken.error().message.find("ask for 1 to 256"), std::string::npos) << broken.error().message;
    }
}

TEST(Patterns, PlaceTheSameSitesEveryTimeAndOthersForAnotherSeed) {
    for (const Pattern pattern : {Pattern::Uniform, Pattern::Impact, Pattern::Paper}) {
        brittle::FractureOptions options;
        options.site_count = 70;
        options.pattern = pattern;
        options.impact.contact_radius = 0.1;
        const std::vector<Double3> first = sitesOf("builtin:ring", options);
        EXPECT_EQ(first, sitesOf("builtin:ring", options));
        options.seed = 2;
        EXPECT_NE(first, sitesOf("builtin:ring", options));
    }
}

TEST(Patterns, RefuseImpactsThatAreNoPlaceOrHaveNoStrength) {
    const whole::Model cube = whole::modelFrom("builtin:cube");
    for (const brittle::Impact& impact : {brittle::Impact{{NAN, 0, 0}, 1, 1}, brittle::Impact{{1e9, 0, 0}, 1, 1},
                                          brittle::Impact{{0, 0, 0}, -1, 1}, brittle::Impact{{0, 0, 0}, NAN, 1}}) {
        brittle::FractureOptions options;
        options.pattern = Pattern::Impact;
        options.impact = impact;
        const auto result = whole::fracture().shatter(cube.prepared.mesh, cube.prepared.topology, options);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, engine::ErrorCode::BadInput);
    }
}

} // namespace
