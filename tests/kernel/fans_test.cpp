// cap_fans, cap_faces_convex and cap_fans_convex on polygons made by hand: a fan has the polygon's outline and its area, and is
// taken for a cap only where none of its triangles is turned over.
#include "tests/kernel/cap_polygons.h"

#include <random>

namespace kernel_test {
namespace {

CapLoop circleOf(uint32_t corners, double radius, CapPoint middle = {0, 0}) {
    CapLoop loop;
    for (uint32_t k = 0; k < corners; ++k) {
        const double angle = 2 * std::numbers::pi * k / corners;
        loop.push_back({middle[0] + static_cast<int32_t>(radius * std::cos(angle)),
                        middle[1] + static_cast<int32_t>(radius * std::sin(angle))});
    }
    return loop;
}

CapPolygon convexOf(uint32_t corners) { return polygonOf({circleOf(corners, 4e6)}); }

// A wave of so many corners that three corners opposite see whole; the last one has the greatest name.
CapPolygon waveOf(uint32_t corners) {
    CapLoop loop;
    for (uint32_t k = 0; k < corners; ++k)
        loop.push_back({static_cast<int32_t>(1000 * (corners - k)), k % 2 == 0 ? 0 : 700});
    for (const CapPoint& p : {CapPoint{0, -1'000'000}, CapPoint{500 * static_cast<int32_t>(corners), -1'100'000},
                              CapPoint{1000 * static_cast<int32_t>(corners), -1'000'000}})
        loop.push_back(p);
    return polygonOf({loop});
}

TEST(SmallFans, OfConvexPolygonsNeedNoEars) {
    std::vector<CapPolygon> polygons;
    for (const uint32_t corners : {25u, 31u, 32u, 63u, 64u, 65u, 256u, 257u, 2048u})
        polygons.push_back(convexOf(corners));
    for (const CapBasis& basis : kCapBases) {
        if (&basis - kCapBases.data() >= 6) break; // no room for so large ones
        const CapRun run = capOnDevice(polygons, basis, Through::AllInTurn);
        for (size_t f = 0; f < polygons.size(); ++f)
            expectTriangulated(polygons[f], run.triangles[f]);
        EXPECT_EQ(run.wide, polygons.size());
        EXPECT_EQ(run.large + run.huge + run.bad, 0u);
    }
}

TEST(SmallFans, OfWavesThatACornerSeesWhole) {
    const std::vector<CapPolygon> polygons = {waveOf(25), waveOf(28), waveOf(300)};
    const CapRun run = capOnDevice(polygons, kCapBases[0], Through::AllInTurn);
    for (size_t f = 0; f < polygons.size(); ++f)
        expectTriangulated(polygons[f], run.triangles[f]);
    EXPECT_EQ(run.large + run.huge + run.bad, 0u);
}

// No corner sees these whole, or would with some triangle turned over: holes, islands, corners in line.
TEST(SmallFans, PassOnWhatNoCornerSeesWhole) {
    CapLoop hole = circleOf(30, 1000);
    std::reverse(hole.begin(), hole.end());
    CapLoop in_line; // a square with eight corners on every side
    for (const CapPoint& way : {CapPoint{1, 0}, CapPoint{0, 1}, CapPoint{-1, 0}, CapPoint{0, -1}})
        for (int32_t k = 0; k < 8; ++k) {
            const CapPoint from = in_line.empty() ? CapPoint{0, 0} : in_line.back();
            in_line.push_back({from[0] + 100 * way[0], from[1] + 100 * way[1]});
        }
    const std::vector<CapPolygon> polygons = {polygonOf({circleOf(30, 3000), hole}),
                                              polygonOf({circleOf(30, 3000), circleOf(30, 3000, {7000, 0})}),
                                              polygonOf({in_line})};
    const CapRun run = capOnDevice(polygons, kCapBases[0], Through::AllInTurn);
    for (size_t f = 0; f < polygons.size(); ++f)
        expectTriangulated(polygons[f], run.triangles[f]);
    EXPECT_EQ(run.large, polygons.size());
    EXPECT_EQ(run.bad, 0u);
}

void expectFans(const std::vector<CapPolygon>& polygons) {
    const CapRun run = capOnDevice(polygons, kCapBases[0], Through::Convex);
    for (size_t f = 0; f < polygons.size(); ++f)
        expectTriangulated(polygons[f], run.triangles[f]);
    EXPECT_EQ(run.large + run.huge + run.bad, 0u);
}

TEST(SmallConvexFans, OfConvexPolygons) {
    std::vector<CapPolygon> polygons;
    for (const uint32_t corners : {3u, 4u, 5u, 23u, 24u, 25u, 63u, 64u, 65u, 255u, 1024u, 2048u})
        polygons.push_back(convexOf(corners));
    expectFans(polygons);
}

TEST(SmallConvexFans, OfAsManyFacesAsThereAre) {
    for (const uint32_t count : kSizes) {
        std::mt19937 random(count);
        std::vector<CapPolygon> polygons;
        for (uint32_t f = 0; f < count; ++f)
            polygons.push_back(convexOf(static_cast<uint32_t>(3 + random() % 40)));
        expectFans(polygons);
    }
}

// The outline of a face of the mesh in the bisector is taken out: all of the cap, or a half of it.
TEST(SmallConvexFans, LeaveOutFacesOfTheMesh) {
    std::vector<CapPolygon> polygons;
    for (const uint32_t corners : {8u, 40u, 1000u}) {
        const CapLoop loop = circleOf(corners, 4e6);
        for (const uint32_t part : {corners, corners / 2 + 1}) {
            CapLoop taken(loop.begin(), loop.begin() + part);
            std::reverse(taken.begin(), taken.end());
            CapPolygon& polygon = polygons.emplace_back(polygonOf({loop, taken}));
            polygon.triangles = corners - part == 0 ? 0 : corners - part;
            polygon.flat_from = corners;
        }
    }
    expectFans(polygons);
}

// Where a cap is not convex its fan still has its outline and its area, so that fragments are closed; but triangles are turned
// over, and the host sees that.
TEST(SmallConvexFans, OfOtherPolygonsAreClosedAllTheSame) {
    CapLoop hole = circleOf(30, 1000);
    std::reverse(hole.begin(), hole.end());
    std::vector<CapPolygon> polygons = {polygonOf({circleOf(30, 3000), hole}), waveOf(41),
                                        polygonOf({{{0, 0}, {40, 0}, {40, 10}, {10, 10}, {10, 30}, {0, 30}}})};
    for (CapPolygon& polygon : polygons) {
        polygon.triangles.reset();
        polygon.crosses = 1 << 30;
    }
    expectFans(polygons);
}

} // namespace
} // namespace kernel_test
