// That errors are seen: results that are right have none, and what is done to them shows in the kind that it should.
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/mesh/primitives.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/support/fragment_sets.h"
#include "tools/accuracy/fracture_truth.h"
#include "tools/accuracy/scene_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using accuracy::MeasuredError;
namespace kinds = accuracy::kinds;

double valueOf(const std::vector<MeasuredError>& errors, const accuracy::ErrorKind& kind) {
    const auto found = std::ranges::find(errors, kind.name, &MeasuredError::kind);
    EXPECT_NE(found, errors.end()) << kind.name;
    return found == errors.end() ? -1 : found->value;
}

// The unit cube in two, as made by hand, and what becomes of it.
class FractureErrors : public testing::Test {
protected:
    void SetUp() override {
        const support::CubeInTwo cube = support::cubeInTwo();
        result_.fragments = cube.set;
        result_.sites = cube.sites;
        const auto model = brittle::prepareMesh(brittle::makeCube());
        ASSERT_TRUE(model);
        truth_ = accuracy::truthOf(model->mesh, result_.sites);
    }
    std::vector<MeasuredError> errors() const { return accuracy::errorsOf(truth_, result_); }
    // A corner of the cut.
    brittle::FragmentVertex& cutCorner(size_t fragment) {
        const brittle::Fragment& f = result_.fragments.fragments[fragment];
        return result_.fragments.vertices[f.first_vertex + result_.fragments.indices[f.first_index + f.outer_index_count]];
    }

    brittle::FractureResult result_;
    accuracy::FractureTruth truth_;
};

TEST_F(FractureErrors, AreNoneOfACubeInTwo) {
    EXPECT_TRUE(truth_.is_convex);
    EXPECT_NEAR(truth_.volume, 1, 1e-15);
    for (const MeasuredError& error : errors())
        EXPECT_LE(error.value, error.resolution) << error.kind;
}

TEST_F(FractureErrors, ShowACornerThatIsOff) {
    // The same place in both fragments, so that they still fit.
    const brittle::Double3 place = positionOf(cutCorner(0));
    for (brittle::FragmentVertex& vertex : result_.fragments.vertices)
        if (positionOf(vertex) == place) vertex.position[0] += 0.01f;
    EXPECT_NEAR(valueOf(errors(), kinds::kCorners), 0.01 / std::sqrt(3.0), 1e-4);
    EXPECT_GT(valueOf(errors(), kinds::kCellVolume), 1e-3);
    EXPECT_LT(valueOf(errors(), kinds::kVolume), 1e-6);
}

TEST_F(FractureErrors, ShowATriangleThatIsTurnedOver) {
    const brittle::Fragment& f = result_.fragments.fragments[0];
    std::swap(result_.fragments.indices[f.first_index + f.outer_index_count],
              result_.fragments.indices[f.first_index + f.outer_index_count + 1]);
    EXPECT_GT(valueOf(errors(), kinds::kTurned), 0.1);
    EXPECT_GT(valueOf(errors(), kinds::kPromises), 0);
}

TEST_F(FractureErrors, ShowAFragmentThatIsMissing) {
    const double volume = result_.fragments.fragments.back().volume;
    result_.fragments.fragments.pop_back();
    EXPECT_NEAR(valueOf(errors(), kinds::kVolume), volume, 1e-6);
    EXPECT_GT(valueOf(errors(), kinds::kNeighbors), 0);
    EXPECT_EQ(valueOf(errors(), kinds::kCorners), 1);
}

TEST_F(FractureErrors, OfNothingAreAllOfIt) {
    result_.fragments = {};
    EXPECT_EQ(valueOf(errors(), kinds::kPromises), 1e6);
}

// A body of the scene, somewhere else.
accuracy::Moment momentAt(const accuracy::SceneStart& start, double seconds, const brittle::Double3& way) {
    accuracy::Moment moment{seconds, start.contents.bodies};
    gpu::BodyState& body = moment.bodies.front();
    body.offset.x += static_cast<float>(way[0]);
    body.offset.y += static_cast<float>(way[1]);
    body.offset.z += static_cast<float>(way[2]);
    return moment;
}

accuracy::SceneStart startOf(const char* name) {
    auto scene = brittle::makeBuiltinScene(name);
    EXPECT_TRUE(scene);
    auto contents = brittle::contentsOf(*scene, ".", nullptr);
    EXPECT_TRUE(contents);
    return {std::move(*scene), std::move(*contents)};
}

double errorAfter(accuracy::MakeTruth make, const accuracy::SceneStart& start, const std::vector<accuracy::Moment>& moments) {
    const accuracy::FineRun none;
    const auto truth = make(start, none);
    for (const accuracy::Moment& moment : moments)
        truth->see(moment);
    return truth->errors().front().value;
}

// 2 m down at 10 m/s2 take 0.632 s; half as fast it goes up to half a meter.
TEST(SceneErrors, OfABounceAreTheDistanceFromItsParabolas) {
    const accuracy::SceneStart start = startOf("hard_17_bounce_50");
    const double down = std::sqrt(0.4), top = 1.5 * down;
    const std::vector<accuracy::Moment> right = {momentAt(start, 0, {0, 0, 0}), momentAt(start, 0.2, {0, -0.2, 0}),
                                                 momentAt(start, top, {0, -1.5, 0})};
    EXPECT_LT(errorAfter(accuracy::bounceTruth, start, right), 0.001);
    EXPECT_NEAR(errorAfter(accuracy::bounceTruth, start, {momentAt(start, 0.2, {0, -0.21, 0})}), 10, 0.01);
    EXPECT_NEAR(errorAfter(accuracy::bounceTruth, start, {momentAt(start, top, {0, -1.48, 0})}), 20, 0.01);
}

TEST(SceneErrors, OfAStackAreTheFurthestWay) {
    const accuracy::SceneStart start = startOf("stack_10");
    EXPECT_EQ(errorAfter(accuracy::stackTruth, start, {momentAt(start, 0, {0, 0, 0}), momentAt(start, 1, {0, 0, 0})}), 0);
    EXPECT_NEAR(errorAfter(accuracy::stackTruth, start,
                           {momentAt(start, 0, {0, 0, 0}), momentAt(start, 1, {0.03, 0, 0.04}), momentAt(start, 2, {0, 0, 0})}),
                50, 0.01);
}

// The wall's face is at 4.975 m, the cube's at 5 cm.
TEST(SceneErrors, OfAShotAreHowFarItIsBeyondTheWallsFace) {
    const accuracy::SceneStart start = startOf("hard_10_wall_300");
    EXPECT_EQ(errorAfter(accuracy::shotTruth, start, {momentAt(start, 1, {4.9, 0, 0})}), 0);
    EXPECT_NEAR(errorAfter(accuracy::shotTruth, start, {momentAt(start, 1, {4.935, 0, 0})}), 10, 0.01);
}

TEST(SceneErrors, OfAPileAreItsOverlapsAndWhatItGains) {
    const accuracy::SceneStart start = startOf("hard_03_overlap_1cm");
    const accuracy::FineRun none;
    const auto truth = accuracy::pileTruth(start, none);
    for (const double seconds : {0.0, 0.1})
        truth->see(momentAt(start, seconds, {0, 0, 0}));
    EXPECT_NEAR(valueOf(truth->errors(), kinds::kPenetration), 10, 0.01);
    EXPECT_EQ(valueOf(truth->errors(), kinds::kEnergy), 0);
}

TEST(SceneErrors, OfASpinAreNoneWhereItTurnsAsItShould) {
    const accuracy::SceneStart start = startOf("hard_08_intermediate_axis");
    const accuracy::FineRun none;
    const auto still = accuracy::spinTruth(start, none);
    still->see(momentAt(start, 0, {0, 0, 0}));
    EXPECT_LT(valueOf(still->errors(), kinds::kTurn), 1e-4);
    still->see(momentAt(start, 0.1, {0, 0, 0})); // it should have turned by a radian
    EXPECT_NEAR(valueOf(still->errors(), kinds::kTurn), 57.3, 0.1);
}

} // namespace
