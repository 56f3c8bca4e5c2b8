// The exact predicates of the kernels against determinants of big integers with weights tried one by one. Sites and corners
// come from grids of very different fineness: on the coarse ones nearly every answer is a tie.
#include "tests/kernel/lab.h"
#include "tests/reference/predicates.h"

#include <random>
#include <set>

namespace kernel_test {
namespace {

using namespace reference;

constexpr int32_t kGrids[] = {2, 4, 16, 1000, 1 << 24};
constexpr uint32_t kQuestions = 4000; // per grid

class Draw {
public:
    explicit Draw(int32_t steps) : steps_(steps), random_(static_cast<uint64_t>(steps)) {}
    uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_() % n); }
    int32_t coordinate() { return static_cast<int32_t>(random_() % static_cast<uint64_t>(steps_ + 1)) * ((1 << 24) / steps_); }
    GridPoint point() { return {coordinate(), coordinate(), coordinate()}; }
    // Different places, ids in any order.
    std::vector<Site> sites(size_t count) {
        std::set<GridPoint> places;
        while (places.size() < count)
            places.insert(point());
        std::vector<Site> sites;
        std::set<uint32_t> ids;
        for (const GridPoint& place : places) {
            uint32_t id = below(1000);
            while (!ids.insert(id).second)
                id = below(1000);
            sites.push_back({place, id});
        }
        std::shuffle(sites.begin(), sites.end(), random_);
        return sites;
    }

private:
    int32_t steps_;
    std::mt19937_64 random_;
};

Int4 words(const Site& site) { return {site.at[0], site.at[1], site.at[2], static_cast<int32_t>(site.id)}; }
Int4 words(const GridPoint& p) { return {p[0], p[1], p[2], 0}; }

Int4 words(const CellPlane& plane) {
    if (plane.kind == CellPlane::Kind::Bisector) return words(plane.site);
    const uint32_t id = BOX_BASE + 2 * plane.axis + (plane.kind == CellPlane::Kind::UpperWall);
    return {static_cast<int32_t>(plane.axis), plane.coordinate, 0, static_cast<int32_t>(id)};
}

CellPlane drawPlane(Draw& draw, const Site& site) {
    if (draw.below(4) != 0) return {CellPlane::Kind::Bisector, site, 0, 0};
    const bool upper = draw.below(2) == 1;
    return {upper ? CellPlane::Kind::UpperWall : CellPlane::Kind::LowerWall, {}, draw.below(3), upper ? 1 << 24 : 0};
}

TEST(ExactCut, AgreesWithDeterminantsAndWeights) {
    for (const int32_t steps : kGrids) {
        Draw draw(steps);
        std::vector<Int4> inputs;
        std::vector<int32_t> expected;
        for (uint32_t q = 0; q < kQuestions; ++q) {
            const std::vector<Site> sites = draw.sites(5);
            const std::array<CellPlane, 3> planes = {drawPlane(draw, sites[1]), drawPlane(draw, sites[2]),
                                                     drawPlane(draw, sites[3])};
            for (const Int4& w : {words(sites[0]), words(planes[0]), words(planes[1]), words(planes[2]), words(sites[4])})
                inputs.push_back(w);
            expected.push_back(planesTurn(sites[0], planes) == 0 ? -1 : cutsCorner(sites[0], planes, sites[4]));
        }
        const engine::Buffer in = bufferOf(inputs), out = blankBuffer<int32_t>(kQuestions);
        onDevice([&](engine::Commands& commands) {
            commands.dispatch(testKernel("corner_cuts"), kQuestions, kQuestions, {in, out});
        });
        EXPECT_EQ(valuesOf<int32_t>(out, kQuestions), expected) << "grid of " << steps;
    }
}

TEST(MeshSigns, AgreeWithDeterminantsAndWeights) {
    for (const int32_t steps : kGrids) {
        Draw draw(steps);
        std::vector<Int4> inputs, expected;
        for (uint32_t q = 0; q < kQuestions; ++q) {
            const std::vector<Site> s = draw.sites(4);
            const std::array<GridPoint, 3> t = {draw.point(), draw.point(), draw.point()};
            for (const Int4& w : {words(s[0]), words(s[1]), words(s[2]), words(s[3]), words(t[0]), words(t[1]), words(t[2])})
                inputs.push_back(w);
            const TriangleLine j{{}, s[1]}, k{{}, s[2]};
            expected.push_back({edgeSign(s[0], s[1], s[3], t[0], t[1]).value_or(9),
                                triangleSign(s[0], {j, k}, s[3], t).value_or(9),
                                triangleSign(s[0], {TriangleLine{0u, {}}, j}, s[3], t).value_or(9),
                                triangleSign(s[0], {j, TriangleLine{2u, {}}}, s[3], t).value_or(9)});
        }
        const engine::Buffer in = bufferOf(inputs), out = blankBuffer<Int4>(kQuestions);
        onDevice([&](engine::Commands& commands) {
            commands.dispatch(testKernel("mesh_signs"), kQuestions, kQuestions, {in, out});
        });
        EXPECT_EQ(valuesOf<Int4>(out, kQuestions), expected) << "grid of " << steps;
    }
}

struct Ratio {
    uint64_t num[2], den[2];
};

// q is floor(2^32 num / den) exactly when q den <= 2^32 num < (q + 1) den.
TEST(FractionOf, IsTheFloorOfTheExactQuotient) {
    std::mt19937_64 random(3);
    std::vector<Ratio> ratios;
    for (uint32_t k = 0; k < 5000; ++k) {
        Ratio r{{random(), random() >> (2 + random() % 62)}, {random(), random() >> (2 + random() % 62)}};
        if (k % 3 == 0) r.num[1] = r.den[1] = 0;
        if (k % 10 == 0) r.num[0] = r.den[0], r.num[1] = r.den[1];
        if (BigInt::fromWords(r.den, 2) < BigInt::fromWords(r.num, 2)) std::swap(r.num, r.den);
        ratios.push_back(r);
    }
    const uint32_t n = static_cast<uint32_t>(ratios.size());
    const engine::Buffer in = bufferOf(ratios), out = blankBuffer<uint64_t>(n), points = blankBuffer<uint32_t>(6 * n);
    onDevice([&](engine::Commands& commands) { commands.dispatch(testKernel("fractions"), n, n, {in, out, points}); });
    const std::vector<uint64_t> fractions = valuesOf<uint64_t>(out, n);
    const std::vector<int64_t> places = valuesOf<int64_t>(points, 3 * n);
    for (uint32_t k = 0; k < n && !HasFailure(); ++k) {
        const BigInt num = BigInt::fromWords(ratios[k].num, 2) * BigInt(int64_t{1} << 32),
                     den = BigInt::fromWords(ratios[k].den, 2);
        const BigInt q(static_cast<int64_t>(fractions[k]));
        EXPECT_FALSE(num < q * den) << k;
        EXPECT_TRUE(num < (q + BigInt(1)) * den) << k;
        // From 3 to 5 and from 5 to 3 at the same share, in units of 2^-24: floors, so that each may be one unit low.
        const double share = static_cast<double>(fractions[k]) / 4294967296.0;
        EXPECT_NEAR(static_cast<double>(places[3 * k]), (3 + 2 * share) * (1 << 24), 1.01) << k;
        EXPECT_NEAR(static_cast<double>(places[3 * k + 1]), (5 - 2 * share) * (1 << 24), 1.01) << k;
        EXPECT_EQ(places[3 * k + 2], -1) << k;
    }
}

} // namespace
} // namespace kernel_test
