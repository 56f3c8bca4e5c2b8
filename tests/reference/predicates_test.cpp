#include "tests/reference/predicates.h"

#include <gtest/gtest.h>

#include <random>

namespace reference {
namespace {

TEST(BigInt, AgreesWithNativeArithmetic) {
    __extension__ using Wide = __int128;
    std::mt19937_64 random(1);
    for (int k = 0; k < 1000; ++k) {
        const int64_t a = static_cast<int64_t>(random()) >> random() % 64, b = static_cast<int64_t>(random()) >> random() % 64;
        EXPECT_EQ(BigInt(a) + BigInt(b), BigInt::fromWide(Wide(a) + b));
        EXPECT_EQ(BigInt(a) - BigInt(b), BigInt::fromWide(Wide(a) - b));
        EXPECT_EQ(BigInt(a) * BigInt(b), BigInt::fromWide(Wide(a) * b));
        EXPECT_EQ(BigInt(a) < BigInt(b), a < b);
        EXPECT_EQ(BigInt(a).sign(), (a > 0) - (a < 0));
    }
}

TEST(BigInt, GoesBeyondNativeArithmetic) {
    const BigInt a(int64_t{1} << 62), b = a * a * a; // 2^186
    EXPECT_EQ(b.word(2), uint64_t{1} << 58);
    EXPECT_EQ((b - b).sign(), 0);
    EXPECT_EQ((BigInt(0) - b).sign(), -1);
    EXPECT_EQ((b - (b + BigInt(1))).sign(), -1);
    const uint64_t words[3] = {0, 0, uint64_t{1} << 58};
    EXPECT_EQ(BigInt::fromWords(words, 3), b);
}

TEST(Predicates, CornerOfACubeIsCutByANearSite) {
    const Site self{{0, 0, 0}, 0};
    const std::array<CellPlane, 3> walls = {CellPlane{CellPlane::Kind::UpperWall, {}, 0, 10},
                                            CellPlane{CellPlane::Kind::UpperWall, {}, 1, 10},
                                            CellPlane{CellPlane::Kind::UpperWall, {}, 2, 10}};
    EXPECT_EQ(planesTurn(self, walls), 1);
    EXPECT_TRUE(cutsCorner(self, walls, {{19, 19, 19}, 1}));
    EXPECT_FALSE(cutsCorner(self, walls, {{21, 21, 21}, 1}));
    EXPECT_FALSE(cutsCorner(self, walls, {{20, 20, 20}, 1})) << "equally near: the lower id keeps its corner";
    EXPECT_TRUE(cutsCorner({{0, 0, 0}, 1}, walls, {{20, 20, 20}, 0}));
}

TEST(Predicates, EdgeSignFindsTheNearerSite) {
    const Site self{{0, 0, 0}, 5}, j{{10, 0, 0}, 6};
    const GridPoint a = {0, 0, 0}, b = {10, 0, 0};
    EXPECT_EQ(edgeSign(self, j, {{5, 9, 0}, 7}, a, b), 1);
    EXPECT_EQ(edgeSign(self, j, {{5, 4, 0}, 7}, a, b), -1);
    EXPECT_EQ(edgeSign(self, j, {{5, 5, 0}, 7}, a, b), 1) << "a tie: l is the lightest";
    EXPECT_EQ(edgeSign(self, j, {{5, 5, 0}, 4}, a, b), -1) << "a tie: l is the heaviest";
    EXPECT_EQ(edgeSign(self, j, {{5, 5, 0}, 4}, {5, 0, 0}, {5, 1, 0}), std::nullopt);
}

TEST(Predicates, TriangleSignFindsTheNearerSite) {
    const Site self{{0, 0, 0}, 5}, j{{10, 0, 0}, 6}, k{{0, 10, 0}, 7};
    const std::array<GridPoint, 3> triangle = {GridPoint{0, 0, 0}, GridPoint{30, 0, 0}, GridPoint{0, 30, 0}};
    const std::array<TriangleLine, 2> bisectors = {TriangleLine{{}, j}, TriangleLine{{}, k}}; // cross at (5, 5, 0)
    EXPECT_EQ(triangleSign(self, bisectors, {{11, 11, 0}, 8}, triangle), 1);
    EXPECT_EQ(triangleSign(self, bisectors, {{9, 9, 0}, 8}, triangle), -1);
    // Ties, worked out by hand. A heavy self pushes both bisectors outward, and their crossing with them, beyond l's.
    EXPECT_EQ(triangleSign(self, bisectors, {{10, 10, 0}, 8}, triangle), -1);
    EXPECT_EQ(triangleSign(self, bisectors, {{10, 10, 0}, 4}, triangle), -1);
    const std::array<TriangleLine, 2> heavy_j = {TriangleLine{{}, {j.at, 1}}, TriangleLine{{}, k}};
    EXPECT_EQ(triangleSign(self, heavy_j, {{10, 10, 0}, 8}, triangle), 1);
    const std::array<TriangleLine, 2> edge = {TriangleLine{0u, {}}, TriangleLine{{}, j}}; // cross at (5, 0, 0)
    EXPECT_EQ(triangleSign(self, edge, {{5, 4, 0}, 8}, triangle), -1);
    EXPECT_EQ(triangleSign(self, edge, {{5, 6, 0}, 8}, triangle), 1);
    const std::array<TriangleLine, 2> same = {TriangleLine{{}, j}, TriangleLine{{}, {{20, 0, 0}, 9}}};
    EXPECT_EQ(triangleSign(self, same, k, triangle), std::nullopt);
}

} // namespace
} // namespace reference
