// Worlds of a few bodies: what every engineer can work out on paper.
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/engine/test_device.h"
#include "tests/support/rigid_bodies.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using brittle::BodyDefinition;
using brittle::Double3;
using brittle::StepSettings;
using brittle::World;
using brittle::WorldContents;

std::unique_ptr<World> worldOf(const std::vector<BodyDefinition>& bodies, const StepSettings& settings = {}) {
    WorldContents contents;
    for (const BodyDefinition& body : bodies) {
        const auto added = brittle::addBody(contents, body);
        EXPECT_TRUE(added) << added.error().message;
    }
    auto world = World::create(engine_test::device(), contents, settings);
    if (!world) {
        ADD_FAILURE() << world.error().message;
        return nullptr;
    }
    return std::move(*world);
}

void run(World& world, uint32_t steps) {
    const auto done = world.step(steps);
    ASSERT_TRUE(done) << done.error().message;
}

Double3 placeOf(const gpu::BodyState& b) {
    return {16.0 * b.sector.x + b.offset.x, 16.0 * b.sector.y + b.offset.y, 16.0 * b.sector.z + b.offset.z};
}

std::vector<gpu::BodyState> bodiesOf(World& world) {
    auto bodies = world.bodies();
    EXPECT_TRUE(bodies);
    return bodies ? *bodies : std::vector<gpu::BodyState>();
}

// Symplectic Euler in substeps: after n of them the way is g h^2 n (n + 1) / 2.
TEST(World, ABodyFallsAsGravityHasIt) {
    auto world = worldOf({support::box({1, 1, 1}, {3, 100, -20})});
    run(*world, 60);
    const gpu::BodyState body = bodiesOf(*world).at(0);
    const double h = 1.0 / 240, fallen = 9.81 * h * h * 240 * 241 / 2;
    EXPECT_NEAR(placeOf(body)[1], 100 - fallen, 1e-4);
    EXPECT_NEAR(body.velocity.y, -9.81, 1e-4);
    EXPECT_EQ(placeOf(body)[0], 3);
    EXPECT_EQ(placeOf(body)[2], -20);
}

TEST(SmallWorld, ABoxRestsOnTheGround) {
    auto world = worldOf({support::ground(), support::box({1, 1, 1}, {0, 0.5, 0})});
    run(*world, 120);
    const gpu::BodyState body = bodiesOf(*world).at(1);
    EXPECT_NEAR(placeOf(body)[1], 0.5, 2e-3);
    EXPECT_NEAR(placeOf(body)[0], 0, 1e-4);
    EXPECT_LT(std::fabs(body.velocity.y), 1e-4);
    const auto counts = world->counts();
    ASSERT_TRUE(counts);
    EXPECT_EQ(counts->contacts, 1u);
}

TEST(World, AStackOfTenCubesStands) {
    std::vector<BodyDefinition> bodies = {support::ground()};
    for (int k = 0; k < 10; ++k)
        bodies.push_back(support::box({1, 1, 1}, {0, 0.5 + k, 0}));
    auto world = worldOf(bodies);
    run(*world, 900);
    const gpu::BodyState top = bodiesOf(*world).back();
    EXPECT_LE(std::hypot(placeOf(top)[0], placeOf(top)[2]), 1e-3);
}

brittle::WorldContents heap() {
    const auto scene = brittle::makeBuiltinScene("hull_pile_100");
    EXPECT_TRUE(scene);
    auto contents = brittle::contentsOf(*scene, ".", nullptr);
    EXPECT_TRUE(contents) << contents.error().message;
    return std::move(*contents);
}

std::unique_ptr<World> worldOf(const brittle::WorldContents& contents, uint32_t group_size = 0) {
    auto world = World::create(engine_test::device(), contents, {}, {0, group_size});
    EXPECT_TRUE(world);
    return std::move(*world);
}

uint64_t hashOf(World& world) {
    const auto hash = world.hash();
    EXPECT_TRUE(hash);
    return hash ? *hash : 0;
}

TEST(World, IsTheSameBitForBitOverRunsAndWorkgroups) {
    const brittle::WorldContents contents = heap();
    const auto first = worldOf(contents);
    run(*first, 90);
    for (const uint32_t group_size : {0u, 16u, 128u}) {
        const auto other = worldOf(contents, group_size);
        run(*other, 45);
        run(*other, 45);
        EXPECT_EQ(hashOf(*other), hashOf(*first)) << group_size;
    }
}

TEST(World, GoesOnFromASavedStateAsIfNothingHadBeen) {
    const brittle::WorldContents contents = heap();
    const auto first = worldOf(contents), second = worldOf(contents);
    run(*first, 61);
    const auto saved = first->save();
    ASSERT_TRUE(saved);
    run(*first, 40);
    run(*second, 8);
    ASSERT_TRUE(second->restore(*saved));
    run(*second, 40);
    EXPECT_EQ(hashOf(*second), hashOf(*first));
    EXPECT_FALSE(second->restore(std::span(*saved).first(saved->size() - 1)));
}

TEST(World, SaysWhatItHadNoRoomForAndDoesNotMakeTheStep) {
    WorldContents contents;
    for (int k = 0; k < 5; ++k)
        ASSERT_TRUE(brittle::addBody(contents, support::box({1, 1, 1}, {0, 0.99 * k, 0})));
    auto world = World::create(engine_test::device(), contents, {}, {3, 0});
    ASSERT_TRUE(world);
    const uint64_t before = hashOf(**world);
    const auto done = (*world)->step(4);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, engine::ErrorCode::Capacity);
    EXPECT_NE(done.error().message.find("finds 4 pairs"), std::string::npos) << done.error().message;
    EXPECT_EQ(hashOf(**world), before);
}

TEST(SmallWorld, RefusesBodiesThatAreNone) {
    WorldContents contents;
    const auto refuses = [&](auto change) {
        BodyDefinition body = support::box({1, 1, 1}, {0, 0, 0});
        change(body);
        const auto added = brittle::addBody(contents, body);
        EXPECT_FALSE(added);
        if (!added) {
            EXPECT_EQ(added.error().message.substr(0, 10), "body \"box\"");
        }
    };
    const double nan = std::nan(""), infinite = INFINITY;
    refuses([&](BodyDefinition& b) { b.place[1] = nan; });
    refuses([&](BodyDefinition& b) { b.place[1] = 2e6; });
    refuses([&](BodyDefinition& b) { b.velocity[0] = infinite; });
    refuses([&](BodyDefinition& b) { b.spin[2] = nan; });
    refuses([&](BodyDefinition& b) { b.turn = {0, 0, 0, 0}; });
    refuses([&](BodyDefinition& b) { b.mass = -1; });
    refuses([&](BodyDefinition& b) { b.mass = nan; });
    refuses([&](BodyDefinition& b) { b.inertia = {1, 1, 3, 0, 0, 0}; });
    refuses([&](BodyDefinition& b) { b.inertia[0] = 0; });
    refuses([&](BodyDefinition& b) { b.friction = -1; });
    refuses([&](BodyDefinition& b) { b.restitution = 1.1; });
    refuses([&](BodyDefinition& b) { b.pieces.clear(); });
    refuses([&](BodyDefinition& b) { b.pieces[0].vertices[3][0] = static_cast<float>(nan); });
    refuses([&](BodyDefinition& b) { b.pieces[0].loops.pop_back(); });
    EXPECT_TRUE(contents.bodies.empty() && contents.pieces.empty() && contents.hulls.records.empty() &&
                contents.hulls.vertices.empty());
}

} // namespace
