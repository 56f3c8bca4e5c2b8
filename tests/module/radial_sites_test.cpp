// Pattern::Radial: plates in spokes and rings about the blow.
#include "modules/brittle/mesh/primitives.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/module/whole_fracture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using brittle::Double3, brittle::Pattern;
using brittle::operator-, brittle::operator+, brittle::operator*;

brittle::FractureOptions radialAt(const Double3& place, uint32_t count, double core = 0.02) {
    brittle::FractureOptions options;
    options.site_count = count;
    options.pattern = Pattern::Radial;
    options.impact = {place, core, 1};
    return options;
}

brittle::FractureResult broken(const whole::Model& model, const brittle::FractureOptions& options) {
    auto result = whole::fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
    EXPECT_TRUE(result) << result.error().message;
    return result ? std::move(*result) : brittle::FractureResult();
}

whole::Model paneOf(double x, double y, double z) {
    return whole::modelFrom(whole::boxOf({-x / 2, -y / 2, -z / 2}, {x / 2, y / 2, z / 2}));
}

struct Case {
    Double3 edges, place;
};
const Case kCases[] = {{{1, 1, 0.006}, {0, 0, 0.003}},  {{1, 1, 0.006}, {0.47, 0.1, 0}},  {{1, 1, 0.006}, {0.5, 0.5, 0}},
                       {{1, 1, 0.3}, {0.1, 0, 0.15}},   {{2, 0.5, 0.01}, {0.3, 0.1, 0}},  {{0.5, 4, 0.01}, {0.2, -1.9, 0}},
                       {{1, 0.004, 1}, {-0.3, 0, 0.2}}, {{1e-3, 0.5e-3, 1e-5}, {0, 0, 0}}};

TEST(RadialSites, AreAsManyAsAreAskedForWhereverAPaneIsHit) {
    for (const Case& c : kCases) {
        const whole::Model pane = paneOf(c.edges[0], c.edges[1], c.edges[2]);
        for (const uint32_t count : {1u, 2u, 3u, 7u, 17u, 64u, 101u, 300u}) {
            const auto result = broken(pane, radialAt(c.place, count));
            EXPECT_EQ(result.counts.sites_used, count);
            EXPECT_EQ(result.fragments.fragments.size(), count) << "no cell is empty";
        }
    }
}

TEST(RadialSites, BreakPanesIntoFragmentsThatKeepTheContract) {
    for (const Case& c : kCases) {
        const whole::Model pane = paneOf(c.edges[0], c.edges[1], c.edges[2]);
        whole::expectContract(pane, radialAt(c.place, 80));
        whole::expectContract(pane, radialAt(c.place, 5, 10));
    }
}

TEST(RadialSites, BreakALensThatIsHitOffItsMiddle) {
    brittle::ImportedMesh lens = brittle::makeIcosphere(3);
    for (auto& p : lens.positions)
        p = {p[0], 0.2 * p[1], p[2]};
    const whole::Model model = whole::modelFrom(lens);
    whole::expectContract(model, radialAt({0.2, 0.05, 0.1}, 90));
}

// Of every face that was cut: its area, and how far its plane is from the axis through the blow.
struct Cut {
    double area = 0, distance = 0;
};

std::vector<Cut> cutsOf(const brittle::FractureResult& result, const Double3& blow) {
    std::vector<Cut> cuts;
    const brittle::FragmentSet& set = result.fragments;
    for (const brittle::Fragment& f : set.fragments)
        for (uint32_t k = f.outer_index_count; k + 2 < f.outer_index_count + f.inner_index_count; k += 3) {
            std::array<Double3, 3> p;
            for (uint32_t c = 0; c < 3; ++c) {
                const auto& at = set.vertices[f.first_vertex + set.indices[f.first_index + k + c]].position;
                p[c] = Double3{double{at[0]}, double{at[1]}, 0} + set.center;
                p[c][2] = double{at[2]};
            }
            const Double3 normal = brittle::cross(p[1] - p[0], p[2] - p[0]);
            const double size = brittle::length(normal);
            if (size > 1e-9)
                cuts.push_back({size / 4, std::fabs(brittle::dot(normal, Double3{blow[0], blow[1], p[0][2]} - p[0])) / size});
        }
    return cuts;
}

double areaOf(const std::vector<Cut>& cuts) {
    double sum = 0;
    for (const Cut& cut : cuts)
        sum += cut.area;
    return sum;
}

constexpr double kNear = 1e-4;

// Radii at which pieces of rings lie, growing, with what they have of area; without those next to nothing lies at.
std::vector<Cut> ringsOf(std::vector<Cut> cuts, double least_area) {
    std::ranges::sort(cuts, {}, &Cut::distance);
    std::vector<Cut> rings;
    for (const Cut& cut : cuts) {
        if (rings.empty() || cut.distance > rings.back().distance + kNear)
            rings.push_back(cut);
        else
            rings.back().area += cut.area;
    }
    std::erase_if(rings, [&](const Cut& ring) { return ring.area < least_area; });
    return rings;
}

TEST(RadialSites, HaveCracksThatAreSpokesThroughTheBlowAndRingsThatGrowByOneRatio) {
    for (const Double3& blow : {Double3{0, 0, 0}, Double3{0.2, 0.1, 0}, Double3{0.5, 0.5, 0}}) {
        const auto cuts = cutsOf(broken(paneOf(1, 1, 0.006), radialAt(blow, 120)), blow);
        const double all = areaOf(cuts);
        std::vector<Cut> spokes, others;
        for (const Cut& cut : cuts)
            (cut.distance < kNear ? spokes : others).push_back(cut);
        EXPECT_GT(areaOf(spokes), 0.3 * all);
        const auto rings = ringsOf(others, 0.01 * all);
        EXPECT_GT(areaOf(spokes) + areaOf(rings), 0.95 * all) << "hardly anything else";
        ASSERT_GE(rings.size(), 4u);
        for (size_t k = 2; k < rings.size(); ++k)
            EXPECT_NEAR(rings[k].distance * rings[k - 2].distance / std::pow(rings[k - 1].distance, 2.0), 1, 0.01);
    }
}

TEST(RadialSites, FollowFromTheSeedAndTheInnermostRingFromTheContact) {
    const whole::Model pane = paneOf(1, 1, 0.006);
    auto options = radialAt({0.1, 0.1, 0}, 90);
    const auto first = broken(pane, options).sites;
    EXPECT_EQ(broken(pane, options).sites, first);
    const auto nearest = [&](const std::vector<Double3>& sites) {
        double least = 1;
        for (const Double3& s : sites)
            least = std::min(least, std::hypot(s[0] - 0.1, s[1] - 0.1));
        return least;
    };
    EXPECT_GT(nearest(broken(pane, radialAt({0.1, 0.1, 0}, 90, 0.2)).sites), 3 * nearest(first));
    options.seed = 2;
    EXPECT_NE(broken(pane, options).sites, first);
}

void expectRefused(const whole::Model& model, const brittle::FractureOptions& options, const std::string& why) {
    const auto result = whole::fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, engine::ErrorCode::BadInput);
    EXPECT_NE(result.error().message.find(why), std::string::npos) << result.error().message;
}

TEST(RadialSites, AreRefusedForWhatIsNoPlateAndForBlowsBesideIt) {
    expectRefused(whole::modelFrom("builtin:cube"), radialAt({0, 0, 0}, 20), "thinner than a third of its width");
    expectRefused(paneOf(1, 0.1, 0.1), radialAt({0, 0, 0}, 20), "use the pattern impact");
    const whole::Model pane = paneOf(1, 1, 0.006);
    expectRefused(pane, radialAt({0.7, 0, 0}, 20), "lies beside the model");
    expectRefused(pane, radialAt({0, 0, 0.1}, 20), "lies beside the model");
    expectRefused(pane, radialAt({NAN, 0, 0}, 20), "not finite");
    expectRefused(pane, radialAt({0, 0, 0}, 20, -1), "negative");
    expectRefused(pane, radialAt({0, 0, 0}, 0), "no sites");
}

} // namespace
