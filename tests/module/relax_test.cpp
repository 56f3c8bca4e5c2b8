// Lloyd's relaxation: sites come to lie in the middle of their cells, and cells become alike.
#include "tests/module/whole_fracture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

brittle::FractureResult shatter(const std::string& name, const brittle::FractureOptions& options) {
    const whole::Model model = whole::modelFrom("builtin:" + name);
    auto result = whole::fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
    EXPECT_TRUE(result) << result.error().message;
    if (!result) return {};
    whole::expectContract(model, *result);
    return std::move(*result);
}

brittle::FractureOptions relaxed(uint32_t sites, uint32_t rounds) {
    brittle::FractureOptions options;
    options.site_count = sites;
    options.relax = rounds;
    return options;
}

// In a cube cells are fragments.
double meanWayToCentroid(const brittle::FractureResult& result) {
    double sum = 0;
    for (const brittle::Fragment& f : result.fragments.fragments)
        sum += std::hypot(f.site[0] - f.centroid[0], f.site[1] - f.centroid[1], f.site[2] - f.centroid[2]);
    return sum / static_cast<double>(result.fragments.fragments.size());
}

double spreadOfVolumes(const brittle::FractureResult& result) {
    const double n = static_cast<double>(result.fragments.fragments.size());
    double sum = 0, squares = 0;
    for (const brittle::Fragment& f : result.fragments.fragments) {
        sum += f.volume / n;
        squares += f.volume * f.volume / n;
    }
    return std::sqrt(squares - sum * sum) / sum;
}

TEST(Relaxation, BringsSitesToTheMiddleOfTheirCells) {
    const brittle::FractureResult before = shatter("cube", relaxed(64, 0)), after = shatter("cube", relaxed(64, 40));
    EXPECT_EQ(after.sites.size(), 64u);
    EXPECT_LT(meanWayToCentroid(after), 0.05 * meanWayToCentroid(before));
    EXPECT_LT(spreadOfVolumes(after), 0.4 * spreadOfVolumes(before));
}

// One site in a box goes to its middle at once; two share it.
TEST(Relaxation, OfOneAndTwoSitesIsExact) {
    const brittle::FractureResult one = shatter("cube", relaxed(1, 1));
    for (const double x : one.sites[0])
        EXPECT_NEAR(x, 0, 1e-3);
    const brittle::FractureResult two = shatter("cube", relaxed(2, 60));
    EXPECT_NEAR(two.fragments.fragments[0].volume, 0.5, 0.01);
}

TEST(Relaxation, KeepsSitesInTheSolidAndIsTheSameEveryTime) {
    for (const brittle::Search search : {brittle::Search::Grid, brittle::Search::SphereTree}) {
        brittle::FractureOptions options = relaxed(120, 5);
        options.search = search;
        const brittle::FractureResult first = shatter("ring", options);
        EXPECT_EQ(first.counts.cells_ok, 120u);
        EXPECT_EQ(first.sites, shatter("ring", options).sites);
    }
}

TEST(Relaxation, SpreadsSitesThatWereGiven) {
    brittle::FractureOptions options = relaxed(0, 80);
    for (uint32_t k = 0; k < 8; ++k)
        options.given_sites.push_back({1e-3 * (k & 1), 1e-3 * (k >> 1 & 1), 1e-3 * (k >> 2)});
    const brittle::FractureResult result = shatter("cube", options);
    for (const brittle::Fragment& f : result.fragments.fragments)
        EXPECT_NEAR(f.volume, 0.125, 0.01);
}

} // namespace
