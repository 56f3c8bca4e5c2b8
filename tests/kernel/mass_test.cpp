// mass_properties and decide_fates: solids whose measures are known in closed form, and components that are fragments,
// cavities or too thin to be either.
#include "tests/kernel/component_pools.h"
#include "tests/kernel/device_event.h"
#include "tests/support/shapes.h"

#include <cmath>

namespace kernel_test {
namespace {

using brittle::FragmentRecord;
using reference::Point;
using reference::Triangles;
using reference::operator+;
using reference::operator*;

struct Measures {
    double volume, area;
    Point centroid, lower, upper;
};

void expectMeasures(const FragmentRecord& record, const Measures& expected) {
    const double size = reference::length(reference::operator-(expected.upper, expected.lower));
    EXPECT_NEAR(record.measure[0], expected.volume, 2e-6 * size * size * size);
    EXPECT_NEAR(record.measure[1], expected.area, 2e-6 * expected.area);
    // Positions are floats about the model's center, so that this far from it they have no more digits.
    const double rounding = 2e-7 * (reference::length(expected.lower) + size);
    for (size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(record.balance[k], expected.centroid[k], 2e-6 * size + rounding);
        EXPECT_NEAR(record.low[k], expected.lower[k], rounding);
        EXPECT_NEAR(record.high[k], expected.upper[k], rounding);
    }
}

Triangles moved(Triangles triangles, const Point& by) {
    for (reference::Triangle& t : triangles)
        for (Point& p : t)
            p = p + by;
    return triangles;
}

// An L, 3 high and 3 wide, of arms 1 thick, from z = 0 to 2: five unit squares, and an outline of 12.
Triangles ellPrism() {
    const std::array<std::array<double, 2>, 6> ell = {{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}};
    const std::array<std::array<size_t, 3>, 4> fan = {{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}};
    const auto at = [&](size_t k, double z) { return Point{ell[k % 6][0], ell[k % 6][1], z}; };
    Triangles prism;
    for (const auto& [a, b, c] : fan) {
        prism.push_back({at(a, 2), at(b, 2), at(c, 2)});
        prism.push_back({at(a, 0), at(c, 0), at(b, 0)});
    }
    for (size_t k = 0; k < 6; ++k) {
        prism.push_back({at(k, 0), at(k + 1, 0), at(k + 1, 2)});
        prism.push_back({at(k, 0), at(k + 1, 2), at(k, 2)});
    }
    return prism;
}

const Triangles kTetrahedron = {{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}},
                                {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}},
                                {{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}}},
                                {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};

TEST(SmallMass, OfATetrahedronAndAnEll) {
    for (const Point& by : {Point{0, 0, 0}, Point{-3, 4, 5}, Point{100, -200, 300}}) {
        const Judged judged = judgeOnDevice({{moved(kTetrahedron, by), 3}, {moved(ellPrism(), by), 9}}, 1e-6f);
        expectMeasures(judged.records[0],
                       {1.0 / 6, 1.5 + std::sqrt(3.0) / 2, by + Point{.25, .25, .25}, by, by + Point{1, 1, 1}});
        const Point middle = {(3 * 1.5 + 2 * .5) / 5, (3 * .5 + 2 * 2.0) / 5, 1};
        expectMeasures(judged.records[1], {10, 10 + 24, by + middle, by, by + Point{3, 3, 2}});
        EXPECT_EQ(judged.records[0].fate[2], 3u);
        EXPECT_EQ(judged.records[1].fate[2], 9u);
    }
}

TEST(SmallMass, OfAsManyCubesAsThereAre) {
    for (const uint32_t count : kSizes) {
        std::vector<Component> cubes;
        std::vector<Measures> expected;
        for (uint32_t c = 0; c < count; ++c) {
            const double side = 1 + c % 10;
            const Point low = {double(c % 7) * 20, double(c % 11) * -10, double(c)}, high = low + Point{side, side, side};
            cubes.push_back({support::boxTriangles(low, high), c});
            expected.push_back({side * side * side, 6 * side * side, .5 * (low + high), low, high});
        }
        const Judged judged = judgeOnDevice(cubes, 1e-6f);
        for (uint32_t c = 0; c < count; ++c) {
            expectMeasures(judged.records[c], expected[c]);
            EXPECT_EQ(judged.records[c].fate[1], c);
            EXPECT_EQ(judged.fates[c], (Word2{FATE_FRAGMENT, c}));
        }
    }
}

// A box of sides a, b, c has V a^2 / 12 about its middle; the tetrahedron's are a textbook's.
TEST(SmallMass, HasSecondMomentsAboutTheCenterOfMass) {
    for (const Point& by : {Point{0, 0, 0}, Point{-3, 4, 5}}) {
        const Judged judged = judgeOnDevice(
            {{support::boxTriangles(by, by + Point{1, 2, 3}), 0}, {moved(kTetrahedron, by), 0}, {moved(ellPrism(), by), 0}},
            1e-6f);
        for (size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(judged.records[0].squares[k], 6 * (1.0 + double(k)) * (1.0 + double(k)) / 12, 1e-5);
            EXPECT_NEAR(judged.records[0].products[k], 0, 1e-5);
            EXPECT_NEAR(judged.records[1].squares[k], 1.0 / 160, 1e-7);
            EXPECT_NEAR(judged.records[1].products[k], -1.0 / 480, 1e-7);
        }
        // Five unit squares two high: their own twelfths, and their ways from the middle at (1.1, 1.1).
        const double own = 10.0 / 12;
        const double xx = own + 2 * (2 * .6 * .6 + .6 * .6 + .4 * .4 + 1.4 * 1.4);
        EXPECT_NEAR(judged.records[2].squares[0], xx, 1e-4);
        EXPECT_NEAR(judged.records[2].squares[1], xx, 1e-4);
        EXPECT_NEAR(judged.records[2].squares[2], 10 * 4.0 / 12, 1e-4);
        // xy: corner (-.6,-.6), along x (.4,-.6) (1.4,-.6), along y the same turned.
        EXPECT_NEAR(judged.records[2].products[0], 2 * (.36 + 2 * (-.24 - .84)), 1e-4);
    }
}

// Four of the twelve triangles of a unit cube; the perimeter is that of all twelve.
TEST(SmallMass, TellsTheModelsSurfaceFromCaps) {
    const Judged judged = judgeOnDevice({{support::boxTriangles({0, 0, 0}, {1, 1, 1}), 0, 4}}, 1e-6f);
    EXPECT_NEAR(judged.records[0].measure[1], 6, 1e-5);
    EXPECT_NEAR(judged.records[0].measure[2], 2, 1e-5);
    EXPECT_NEAR(judged.records[0].measure[3], 12 * (2 + std::sqrt(2.0)), 1e-4);
}

// More triangles than a workgroup has lanes, against sums in double.
TEST(Mass, OfLargeComponents) {
    std::vector<Component> components;
    for (const char* name : {"ring", "bumpy:4", "icosphere:4"}) {
        const brittle::PreparedMesh solid = solidOf(name);
        Component component;
        for (const brittle::Index3& t : solid.mesh.triangles) {
            reference::Triangle triangle;
            for (size_t k = 0; k < 3; ++k)
                for (size_t axis = 0; axis < 3; ++axis)
                    triangle[k][axis] = static_cast<double>(solid.mesh.positions[t[k]][axis]);
            component.triangles.push_back(triangle);
        }
        components.push_back(component);
    }
    const Judged judged = judgeOnDevice(components, 1e-6f);
    for (size_t c = 0; c < components.size(); ++c) {
        const Triangles& triangles = components[c].triangles;
        const reference::Bounds bounds = reference::boundsOf(triangles);
        expectMeasures(judged.records[c], {reference::volumeOf(triangles), reference::areaOf(triangles),
                                           reference::centroidOf(triangles), bounds.lower, bounds.upper});
    }
}

Triangles cavity(double low, double high) {
    return support::turnedOver(support::boxTriangles({low, low, low}, {high, high, high}));
}

class Slots : public testing::TestWithParam<double> {};

TEST(SmallFates, OfACavityIsTheSmallestPieceAroundIt) {
    const Triangles large = support::boxTriangles({0, 0, 0}, {100, 100, 100}),
                    small = support::boxTriangles({20, 20, 20}, {60, 60, 60});
    const Judged judged =
        judgeOnDevice({{cavity(30, 40), 7}, {large, 7}, {cavity(10, 70), 7}, {small, 7}, {cavity(80, 90), 7}}, .01f);
    const std::vector<Word2> expected = {
        {FATE_CAVITY, 3}, {FATE_FRAGMENT, 1}, {FATE_CAVITY, 1}, {FATE_FRAGMENT, 3}, {FATE_CAVITY, 1}};
    EXPECT_EQ(judged.fates, expected);
    EXPECT_EQ(judged.cavities, 3u);
    EXPECT_EQ(judged.films + judged.bad, 0u);
    EXPECT_EQ(judgeOnDevice({{small, 7}, {large, 7}, {cavity(30, 40), 7}}, .01f).fates[2], (Word2{FATE_CAVITY, 0}));
}

// Walls of a slot that have passed through each other by so much.
TEST_P(Slots, BelongToTheFragmentAroundThem) {
    const double width = GetParam();
    const auto wall = [](double at) {
        return Triangles{{{{at, 2, 2}, {at, 8, 2}, {at, 8, 8}}}, {{{at, 2, 2}, {at, 8, 8}, {at, 2, 8}}}};
    };
    const Triangles solid = support::boxTriangles({0, 0, 0}, {10, 10, 10});
    Triangles slot = support::joined(wall(5 + width / 2), support::turnedOver(wall(5 - width / 2)));
    const Triangles outside = moved(slot, {6, 0, 0});
    const Judged judged = judgeOnDevice({{slot, 7}, {solid, 7}, {slot, 6}, {outside, 7}, {slot, 7, 0}}, 1e-5f);
    const std::vector<Word2> expected = {{FATE_CAVITY, 1}, {FATE_FRAGMENT, 1}, {FATE_FILM, 2}, {FATE_FILM, 3}, {FATE_FILM, 4}};
    EXPECT_EQ(judged.fates, expected) << "of the solid's cell, inside, and not made of caps";
    EXPECT_EQ(judged.films, 4u);
}
INSTANTIATE_TEST_SUITE_P(Small, Slots, testing::Values(0.0, 1e-6, -1e-6));

// Bounds alone would put it into the L; and what is around it lies in another cell.
TEST(SmallFates, OfACavityInNothingIsCounted) {
    const Judged in_notch = judgeOnDevice({{ellPrism(), 1}, {moved(cavity(.2, .8), {1.5, 1.5, 0}), 1}}, 1e-4f);
    EXPECT_EQ(in_notch.bad, 1u);
    const Judged in_arm = judgeOnDevice({{ellPrism(), 1}, {moved(cavity(.2, .8), {1.5, 0, 0}), 1}}, 1e-4f);
    EXPECT_EQ(in_arm.bad, 0u);
    EXPECT_EQ(in_arm.fates[1], (Word2{FATE_CAVITY, 0}));
    const Judged in_other_cell = judgeOnDevice({{ellPrism(), 2}, {moved(cavity(.2, .8), {1.5, 0, 0}), 1}}, 1e-4f);
    EXPECT_EQ(in_other_cell.bad, 1u);
}

// Volume over area: a plate of thickness h has h / 2.
TEST(SmallFates, OfPlatesThinnerThanTwoStepsIsOpen) {
    const float step = .01f;
    std::vector<Component> plates;
    for (const double thickness : {.001, .01, .018, .03, .1, 1.0})
        plates.push_back({support::boxTriangles({0, 0, 0}, {100, 100, thickness}), 0});
    const Judged judged = judgeOnDevice(plates, step);
    for (uint32_t c = 0; c < plates.size(); ++c)
        EXPECT_EQ(judged.fates[c], (Word2{c < 3 ? FATE_FILM : FATE_FRAGMENT, c})) << c;
    EXPECT_EQ(judged.films, 3u);
}

// Inside out: a cavity where it is the model's own surface, rounding where it is made of caps.
TEST(SmallFates, OfInvertedPiecesDependsOnTheirSurface) {
    const Triangles around = support::boxTriangles({0, 0, 0}, {100, 100, 100});
    const Judged judged = judgeOnDevice({{cavity(10, 20), 0, 4}, {around, 0}, {cavity(30, 40), 0}}, .01f);
    EXPECT_EQ(judged.fates, (std::vector<Word2>{{FATE_FILM, 0}, {FATE_FRAGMENT, 1}, {FATE_CAVITY, 1}}));
}

} // namespace
} // namespace kernel_test
