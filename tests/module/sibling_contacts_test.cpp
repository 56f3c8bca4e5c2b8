// What a fracture knows of neighbors: where fragments share a face.
#include "modules/brittle/dynamics/sibling_contacts.h"

#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/engine/test_device.h"
#include "tests/support/body_overlaps.h"

#include <gtest/gtest.h>

#include <set>

namespace {

using brittle::SiblingContact;
using brittle::operator-;

brittle::WorldContents brokenBlock() {
    auto scene = *brittle::makeBuiltinScene("hard_01_block_100");
    scene.bodies[0].place = {3, -2, 40};
    scene.bodies[0].turn = {0.1, -0.3, 0.5, 0.8};
    auto fracture = brittle::Fracture::create(engine_test::device());
    EXPECT_TRUE(fracture);
    auto contents = brittle::contentsOf(scene, ".", fracture->get());
    EXPECT_TRUE(contents) << contents.error().message;
    return std::move(*contents);
}

TEST(SmallSiblingContacts, LieInBothPiecesWithTheNormalFromTheFirstToTheSecond) {
    const brittle::WorldContents contents = brokenBlock();
    ASSERT_GT(contents.siblings.size(), 500u);
    for (const SiblingContact& sibling : contents.siblings) {
        const brittle::Pose a = brittle::poseOf(contents.bodies[contents.pieces[sibling.piece_a].ids.y]),
                            b = brittle::poseOf(contents.bodies[contents.pieces[sibling.piece_b].ids.y]);
        EXPECT_GT(brittle::dot(sibling.normal, b.place - a.place), 0);
        EXPECT_NEAR(brittle::dot(sibling.normal, sibling.normal), 1, 1e-5);
        ASSERT_GE(sibling.points.size(), 3u);
        ASSERT_LE(sibling.points.size(), 4u);
        const auto solid_a = support::pieceInWorld(contents, sibling.piece_a, {a.place, a.turn}),
                   solid_b = support::pieceInWorld(contents, sibling.piece_b, {b.place, b.turn});
        for (const brittle::Double3& p : sibling.points) {
            EXPECT_LT(reference::distanceOutside(solid_a, {p[0], p[1], p[2]}), 1e-5);
            EXPECT_LT(reference::distanceOutside(solid_b, {p[0], p[1], p[2]}), 1e-5);
        }
    }
}

TEST(SmallSiblingContacts, AreRememberedOnceAPairInOrder) {
    brittle::WorldContents contents = brokenBlock();
    std::set<std::array<uint32_t, 2>> pairs;
    for (SiblingContact& s : contents.siblings)
        EXPECT_TRUE(pairs.insert({s.piece_a, s.piece_b}).second);
    std::swap(contents.siblings.front(), contents.siblings.back());
    std::swap(contents.siblings[7].piece_a, contents.siblings[7].piece_b);
    for (double& x : contents.siblings[7].normal)
        x = -x;
    const brittle::FirstContacts first = brittle::firstContacts(contents), again = brittle::firstContacts(brokenBlock());
    ASSERT_EQ(first.pairs.size(), pairs.size());
    EXPECT_TRUE(std::equal(pairs.begin(), pairs.end(), first.pairs.begin()));
    for (size_t k = 0; k < first.contacts.size(); ++k)
        EXPECT_EQ(first.contacts[k].normal.y, again.contacts[k].normal.y) << k;
}

} // namespace
