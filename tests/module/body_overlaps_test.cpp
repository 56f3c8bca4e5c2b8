// How deep bodies lie in each other, as the tests of scenes and the bench measure it, on boxes where anyone can see it.
#include "tests/support/body_overlaps.h"

#include "tests/support/rigid_bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using support::Pose;

brittle::WorldContents contentsOf(const std::vector<brittle::BodyDefinition>& bodies) {
    brittle::WorldContents contents;
    for (const brittle::BodyDefinition& body : bodies)
        EXPECT_TRUE(brittle::addBody(contents, body));
    return contents;
}

std::vector<double> overlapsAt(const brittle::WorldContents& contents, const std::vector<brittle::Double3>& places) {
    std::vector<Pose> poses;
    for (const brittle::Double3& place : places)
        poses.push_back({place, {0, 0, 0, 1}});
    return support::overlapsOf(contents, poses);
}

TEST(BodyOverlaps, AreThoseOfTheBodiesWhereTheyAre) {
    const brittle::WorldContents contents =
        contentsOf({support::ground(), support::box({1, 1, 1}, {0, 5, 0}), support::box({1, 1, 1}, {9, 5, 0})});
    EXPECT_TRUE(overlapsAt(contents, {{0, -1, 0}, {0, 0.5001, 0}, {1.0001, 0.5001, 0}}).empty());
    const std::vector<double> depths = overlapsAt(contents, {{0, -1, 0}, {0, 0.49, 0}, {0.97, 0.5001, 0}});
    ASSERT_EQ(depths.size(), 2u);
    EXPECT_NEAR(depths[0], 0.01, 1e-6);
    EXPECT_NEAR(depths[1], 0.03, 1e-6);
}

TEST(BodyOverlaps, GoByTheTurnOfABodyWhateverTheLengthOfItsQuaternion) {
    const brittle::WorldContents contents = contentsOf({support::ground(), support::box({1, 1, 1}, {0, 5, 0})});
    const double eighth = std::numbers::pi / 8;
    const Pose edge_down = {{0, std::sqrt(0.5) - 0.02, 0}, {3 * std::sin(eighth), 0, 0, 3 * std::cos(eighth)}};
    const std::vector<double> depths = support::overlapsOf(contents, std::vector<Pose>{{{0, -1, 0}, {0, 0, 0, 1}}, edge_down});
    ASSERT_EQ(depths.size(), 1u);
    EXPECT_NEAR(depths[0], 0.02, 1e-6);
}

TEST(BodyOverlaps, OfOneBodyOrOfTwoThatNeverMoveAreNone) {
    brittle::BodyDefinition doubled = support::box({1, 1, 1}, {0, 5, 0});
    doubled.pieces.push_back(doubled.pieces[0]);
    const brittle::WorldContents contents = contentsOf({support::ground(), support::ground(), doubled});
    EXPECT_TRUE(overlapsAt(contents, {{0, -1, 0}, {0, -1.5, 0}, {0, 5, 0}}).empty());
}

TEST(BodyOverlaps, KnowTheSectorOfABody) {
    const brittle::WorldContents contents = contentsOf({support::box({1, 1, 1}, {-1234.5, 17, 99'999})});
    const brittle::Double3 place = support::poseOf(contents.bodies[0]).place;
    EXPECT_NEAR(place[0], -1234.5, 1e-6);
    EXPECT_NEAR(place[1], 17, 1e-6);
    EXPECT_NEAR(place[2], 99'999, 1e-6);
}

TEST(BodyOverlaps, APercentileIsOneOfTheValues) {
    EXPECT_EQ(support::percentile({}, 0.99), 0);
    EXPECT_EQ(support::percentile({1, 2, 3}, 0), 1);
    EXPECT_EQ(support::percentile({1, 2, 3}, 0.5), 2);
    EXPECT_EQ(support::percentile({1, 2, 3}, 1), 3);
}

} // namespace
