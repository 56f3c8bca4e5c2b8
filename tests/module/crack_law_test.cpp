// How much crack so many cells have: the law against diagrams of random sites, cut by brute force.
#include "modules/brittle/effects/fragment_count.h"
#include "tests/reference/voronoi.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace {

using brittle::Spread;
using Place = std::array<double, 3>;

constexpr double kGrid = 1 << 22;

double faceArea(const reference::CellFace& face) {
    Place sum = {0, 0, 0};
    for (size_t k = 2; k < face.corners.size(); ++k) {
        Place a, b;
        for (size_t c = 0; c < 3; ++c) {
            a[c] = face.corners[k - 1][c] - face.corners[0][c];
            b[c] = face.corners[k][c] - face.corners[0][c];
        }
        for (size_t c = 0; c < 3; ++c)
            sum[c] += (a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3]) / 2;
    }
    return std::hypot(sum[0], sum[1], sum[2]);
}

// A box of these edges, and where it is hit.
struct Case {
    Place edges, hit;
    double radius; // of the contact
};

// Faces between cells are seen from both sides.
double cracksOf(const Case& c, const std::vector<Place>& sites) {
    reference::SiteSet set;
    for (size_t k = 0; k < 3; ++k)
        set.box.upper[k] = static_cast<int32_t>(std::lround(c.edges[k] * kGrid));
    for (const Place& p : sites)
        set.sites.push_back(
            {static_cast<int32_t>(p[0] * kGrid), static_cast<int32_t>(p[1] * kGrid), static_cast<int32_t>(p[2] * kGrid)});
    double area = 0;
    for (const reference::VoronoiCell& cell : reference::cutAllCells(set))
        for (const reference::CellFace& face : cell.faces)
            if (face.neighbor < sites.size()) area += faceArea(face) / (2 * kGrid * kGrid);
    return area;
}

// By rejection: evenly in the box, kept with a chance that is the density over its most.
class Sites {
public:
    explicit Sites(uint32_t seed) : random_(seed) {}
    std::vector<Place> draw(const Case& c, uint32_t count, Spread spread, bool plate) {
        std::vector<Place> sites;
        while (sites.size() < count) {
            const bool even = spread == Spread::Even || (!plate && sites.size() % 2 == 1);
            Place p;
            for (size_t k = 0; k < 3; ++k)
                p[k] = even_(random_) * c.edges[k];
            const double r = plate ? std::hypot(p[0] - c.hit[0], p[1] - c.hit[1])
                                   : std::hypot(p[0] - c.hit[0], p[1] - c.hit[1], p[2] - c.hit[2]);
            const double density = std::pow(c.radius / std::max(r, c.radius), plate ? 4.0 / 3 : 4.0);
            if (even || even_(random_) < density) sites.push_back(p);
        }
        return sites;
    }

private:
    std::mt19937_64 random_;
    std::uniform_real_distribution<double> even_{0, 1};
};

double meanCracks(const Case& c, uint32_t count, Spread spread, bool plate) {
    Sites sites(count);
    const uint32_t times = count < 10 ? 300 : count < 100 ? 40 : 8;
    double sum = 0;
    for (uint32_t k = 0; k < times; ++k)
        sum += cracksOf(c, sites.draw(c, count, spread, plate)) / times;
    return sum;
}

void expectLaw(const Case& c, Spread spread, bool plate, double share) {
    const auto [x, y, z] = c.edges;
    const brittle::BodyForm form = brittle::formOf(x * y * z, 2 * (x * y + y * z + z * x));
    ASSERT_EQ(brittle::isThin(form), plate);
    for (const uint32_t count : {2u, 3u, 5u, 12u, 40u, 150u, 400u}) {
        const double law = brittle::crackAreaOf(form, count, spread);
        EXPECT_NEAR(meanCracks(c, count, spread, plate) / law, 1, share) << count;
    }
}

constexpr Case kCube = {{1, 1, 1}, {0.5, 0.5, 0}, 0.1}, kCorner = {{1, 1, 1}, {0, 0, 0}, 0.1},
               kBlock = {{1, 1, 0.6}, {0.5, 0.5, 0}, 0.1}, kPane = {{1, 1, 0.01}, {0.5, 0.5, 0}, 0.02},
               kPaneAtRim = {{1, 1, 0.01}, {0.05, 0.3, 0}, 0.02}, kLongPane = {{1.6, 0.8, 0.01}, {0.5, 0.3, 0}, 0.02};

TEST(CrackLaw, OfEvenSitesInASolid) { expectLaw(kCube, Spread::Even, false, 0.05); }
TEST(CrackLaw, OfSitesAboutABlowOnTheFaceOfACube) { expectLaw(kCube, Spread::AboutBlow, false, 0.15); }
TEST(CrackLaw, OfSitesAboutABlowOnTheCornerOfACube) { expectLaw(kCorner, Spread::AboutBlow, false, 0.15); }
TEST(CrackLaw, OfSitesAboutABlowOnABlock) { expectLaw(kBlock, Spread::AboutBlow, false, 0.15); }
TEST(CrackLaw, OfEvenSitesInAPlate) { expectLaw(kPane, Spread::Even, true, 0.15); }
TEST(CrackLaw, OfSitesAboutABlowInTheMiddleOfAPlate) { expectLaw(kPane, Spread::AboutBlow, true, 0.15); }
TEST(CrackLaw, OfSitesAboutABlowNearTheRimOfAPlate) { expectLaw(kPaneAtRim, Spread::AboutBlow, true, 0.15); }
TEST(CrackLaw, OfSitesAboutABlowInALongPlate) { expectLaw(kLongPane, Spread::AboutBlow, true, 0.15); }

} // namespace
