// Worlds of a few bodies: what every engineer can work out on paper.
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "shaders-spirv/shared/solver.h"
#include "tests/engine/test_device.h"
#include "tests/support/rigid_bodies.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

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

// Speeds lag places by half a substep.
TEST(World, ABodyFallsAsGravityHasIt) {
    auto world = worldOf({support::box({1, 1, 1}, {3, 100, -20})});
    run(*world, 60);
    const gpu::BodyState body = bodiesOf(*world).at(0);
    EXPECT_NEAR(placeOf(body)[1], 100 - 9.81 / 2, 1e-4);
    EXPECT_NEAR(body.velocity.y, -9.81 * (1 - 0.5 / 240), 1e-4);
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

brittle::WorldCounts countsOf(World& world) {
    const auto counts = world.counts();
    EXPECT_TRUE(counts);
    return counts ? *counts : brittle::WorldCounts();
}

brittle::WorldContents heap() {
    const auto scene = brittle::makeBuiltinScene("hull_pile_100");
    EXPECT_TRUE(scene);
    auto contents = brittle::contentsOf(*scene, ".", nullptr);
    EXPECT_TRUE(contents) << contents.error().message;
    return std::move(*contents);
}

std::unique_ptr<World> worldOf(const brittle::WorldContents& contents, uint32_t group_size = 0) {
    auto world = World::create(engine_test::device(), contents, {}, {0, 0, group_size});
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

// A heap of boxes of all shapes, added in a given order.
std::unique_ptr<World> heapOf(const std::vector<uint32_t>& order) {
    std::vector<BodyDefinition> bodies;
    for (const uint32_t k : order) {
        const double edge = 0.3 + 0.02 * (k % 9);
        BodyDefinition body = support::box({edge, 0.4, 0.5}, {0.3 * (k % 3), 0.4 + 0.55 * (k / 3), 0.25 * (k % 2)});
        body.id = 7 * k + 3;
        bodies.push_back(body);
    }
    bodies.insert(bodies.begin() + 5, support::ground());
    return worldOf(bodies);
}

TEST(World, IsTheSameBitForBitInWhateverOrderBodiesAreAdded) {
    std::vector<uint32_t> order(30);
    std::iota(order.begin(), order.end(), 0);
    const auto first = heapOf(order);
    run(*first, 90);
    std::ranges::reverse(order);
    std::rotate(order.begin(), order.begin() + 11, order.end());
    const auto other = heapOf(order);
    run(*other, 90);
    EXPECT_EQ(hashOf(*other), hashOf(*first));
    const auto bodies = bodiesOf(*first), shuffled = bodiesOf(*other);
    for (size_t k = 0; k < order.size(); ++k)
        EXPECT_EQ(placeOf(shuffled[k < 5 ? k : k + 1])[1], placeOf(bodies[order[k] < 5 ? order[k] : order[k] + 1])[1]) << k;
}

// Cells of a block touch where it was cut: the first step takes that from the fracture, and has only pairs to look at that meet
// in less than a face, or in cells of several fragments.
TEST(World, TakesTheContactsOfFreshSiblingsFromTheFracture) {
    const auto scene = brittle::makeBuiltinScene("hard_01_block_100");
    ASSERT_TRUE(scene);
    auto fracture = brittle::Fracture::create(engine_test::device());
    ASSERT_TRUE(fracture);
    auto contents = brittle::contentsOf(*scene, ".", fracture->get());
    ASSERT_TRUE(contents) << contents.error().message;
    const auto siblings = static_cast<uint32_t>(contents->siblings.size());
    ASSERT_GT(siblings, 500u);
    const auto known = worldOf(*contents);
    run(*known, 1);
    const brittle::WorldCounts with = countsOf(*known);
    contents->siblings.clear();
    const auto found = worldOf(*contents);
    run(*found, 1);
    const brittle::WorldCounts without = countsOf(*found);
    EXPECT_EQ(without.fresh, without.pairs);
    EXPECT_EQ(with.pairs, without.pairs);
    EXPECT_EQ(with.fresh + siblings, without.fresh);
    EXPECT_GE(with.contacts, siblings);
}

// So many contacts that each color is dispatched on its own.
TEST(World, IsTheSameBitForBitOverRunsOfManyContacts) {
    const auto scene = brittle::makeBuiltinScene("hull_pile_1000");
    ASSERT_TRUE(scene);
    const auto contents = brittle::contentsOf(*scene, ".", nullptr);
    ASSERT_TRUE(contents) << contents.error().message;
    const auto first = worldOf(*contents), second = worldOf(*contents, 128);
    for (const auto& world : {first.get(), second.get()})
        run(*world, 110);
    EXPECT_GT(countsOf(*first).contacts, 1024u);
    EXPECT_EQ(hashOf(*first), hashOf(*second));
}

// A stack on the ground, far from it a box that floats, and one that falls on the stack after two and a half seconds.
std::vector<BodyDefinition> sleepers() {
    std::vector<BodyDefinition> bodies = {support::ground()};
    for (int k = 0; k < 5; ++k)
        bodies.push_back(support::box({1, 1, 1}, {0, 0.5 + k, 0}));
    bodies.push_back(support::box({1, 1, 1}, {0, 40, 0}));
    return bodies;
}

StepSettings sleeping() {
    StepSettings settings;
    settings.sleeping = true;
    return settings;
}

// Where bodies are and how they move; not for how long they have rested.
std::vector<std::array<float, 13>> motionOf(World& world) {
    std::vector<std::array<float, 13>> motion;
    for (const gpu::BodyState& b : bodiesOf(world))
        motion.push_back({b.offset.x, b.offset.y, b.offset.z, b.turn.x, b.turn.y, b.turn.z, b.turn.w, b.velocity.x,
                          b.velocity.y, b.velocity.z, b.spin.x, b.spin.y, b.spin.z});
    return motion;
}

WorldContents heapAndTowers() {
    WorldContents contents = heap();
    for (int tower = 0; tower < 12; ++tower)
        for (int k = 0; k < 5; ++k)
            EXPECT_TRUE(brittle::addBody(contents, support::box({1, 1, 1}, {103.0 + 3 * tower, 0.505 + 1.01 * k, 0})));
    EXPECT_TRUE(brittle::addBody(contents, support::ground()));
    return contents;
}

// With few contacts in all, both walk through colors in the same order.
TEST(World, IslandsThatAreSolvedApartMoveAsTheyDoInOneList) {
    const WorldContents contents = heapAndTowers();
    StepSettings settings;
    settings.sleep_after = 1e9;
    auto apart = World::create(engine_test::device(), contents, settings);
    settings.sleeping = false;
    auto together = World::create(engine_test::device(), contents, settings);
    ASSERT_TRUE(apart && together);
    run(**apart, 150);
    run(**together, 150);
    EXPECT_EQ(motionOf(**apart), motionOf(**together));
    EXPECT_LT(countsOf(**together).contacts, FEW_CONTACTS);
    EXPECT_EQ(countsOf(**apart).contacts, countsOf(**together).contacts);
    EXPECT_EQ(countsOf(**apart).colors, countsOf(**together).colors);
}

TEST(World, AStackThatHasComeToRestSleepsUntilItIsHit) {
    auto world = worldOf(sleepers(), sleeping());
    run(*world, 100);
    EXPECT_EQ(countsOf(*world).awake, 1u); // what falls
    EXPECT_EQ(countsOf(*world).contacts, 0u);
    const auto asleep = bodiesOf(*world);
    run(*world, 40);
    const auto later = bodiesOf(*world);
    for (size_t b = 0; b + 1 < asleep.size(); ++b)
        EXPECT_EQ(std::memcmp(&asleep[b].offset, &later[b].offset, 2 * sizeof(gpu::vec4)), 0);
    float before = 0;
    uint32_t steps = 140;
    for (; steps < 200 && countsOf(*world).awake < 6; ++steps) {
        before = bodiesOf(*world)[6].velocity.y;
        run(*world, 1);
    }
    EXPECT_EQ(countsOf(*world).awake, 6u);
    EXPECT_NEAR(before, -std::sqrt(2 * 9.81 * 34.5), 1);
    auto restless = worldOf(sleepers(), {});
    run(*restless, steps);
    EXPECT_NEAR(bodiesOf(*world)[6].velocity.y, bodiesOf(*restless)[6].velocity.y, 0.1)
        << "they wake in the step that it hits them in";
}

TEST(World, DispatchesNothingWhileAllSleepAndGoesOnCounting) {
    std::vector<BodyDefinition> bodies = sleepers();
    bodies.pop_back();
    auto world = worldOf(bodies, sleeping());
    run(*world, 120);
    const brittle::WorldCounts counts = countsOf(*world);
    EXPECT_EQ(counts.awake, 0u);
    EXPECT_EQ(counts.groups, 0u);
    for (const gpu::BodyState& body : bodiesOf(*world)) {
        EXPECT_EQ(body.velocity.y, 0);
        EXPECT_EQ(body.momentum.x, 0);
    }
    const uint64_t before = hashOf(*world);
    run(*world, 1001);
    EXPECT_EQ(hashOf(*world), before);
}

TEST(World, WakesAfterItWasRestoredAsItWouldHaveWithout) {
    auto first = worldOf(sleepers(), sleeping()), second = worldOf(sleepers(), sleeping());
    run(*first, 121);
    const auto saved = first->save();
    ASSERT_TRUE(saved);
    ASSERT_TRUE(second->restore(*saved));
    for (const auto& world : {first.get(), second.get()})
        run(*world, 50);
    EXPECT_EQ(hashOf(*first), hashOf(*second));
    EXPECT_EQ(countsOf(*second).awake, 6u) << "half a second of rest is not over yet";
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

// Cubes above each other.
WorldContents tower(int cubes, double apart) {
    WorldContents contents;
    for (int k = 0; k < cubes; ++k)
        EXPECT_TRUE(brittle::addBody(contents, support::box({1, 1, 1}, {0, apart * k, 0})));
    return contents;
}

// As worlds do that have to make room for more pairs.
TEST(World, GoesOnFromAStateOfWhenItHadLessRoomOrMore) {
    const brittle::WorldContents contents = heap();
    const auto small = worldOf(contents), grown = worldOf(contents);
    const auto before = small->save();
    ASSERT_TRUE(before);
    brittle::WorldBudget roomy;
    roomy.pairs = 50'000;
    auto large = World::create(engine_test::device(), contents, {}, roomy);
    ASSERT_TRUE(large);
    ASSERT_TRUE((*large)->restore(*before));
    run(*grown, 40);
    run(**large, 40);
    EXPECT_EQ(hashOf(**large), hashOf(*grown));
    const auto later = (*large)->save();
    ASSERT_TRUE(later);
    ASSERT_TRUE(small->restore(*later));
    run(*small, 20);
    run(*grown, 20);
    EXPECT_EQ(hashOf(*small), hashOf(*grown));
    EXPECT_FALSE(worldOf(tower(3, 1.1))->restore(*later));
}

void expectNoRoom(World& world, std::string_view why) {
    const uint64_t before = hashOf(world);
    const auto done = world.step(4);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, engine::ErrorCode::Capacity);
    EXPECT_NE(done.error().message.find(why), std::string::npos) << done.error().message;
    EXPECT_EQ(hashOf(world), before);
}

TEST(World, GoesOnFromAStateOfBeforeItHadNoRoom) {
    auto crowded = World::create(engine_test::device(), tower(5, 0.99), {}, {.pairs = 3}),
         calm = World::create(engine_test::device(), tower(5, 3), {}, {.pairs = 3});
    ASSERT_TRUE(crowded && calm);
    const auto apart = (*calm)->save();
    ASSERT_TRUE(apart);
    expectNoRoom(**crowded, "finds 4 pairs");
    const auto restored = (*crowded)->restore(*apart);
    ASSERT_TRUE(restored) << restored.error().message;
    run(**crowded, 5);
    run(**calm, 5);
    EXPECT_EQ(hashOf(**crowded), hashOf(**calm));
}

TEST(World, SaysWhatItHadNoRoomForAndDoesNotMakeTheStep) {
    const WorldContents contents = tower(5, 0.99);
    auto world = World::create(engine_test::device(), contents, {}, {.pairs = 3});
    ASSERT_TRUE(world);
    expectNoRoom(**world, "finds 4 pairs");
}

TEST(World, SaysHowManyContactsItHadNoRoomFor) {
    const WorldContents contents = tower(5, 0.99);
    auto tight = World::create(engine_test::device(), contents, {}, {.contacts = 3}),
         enough = World::create(engine_test::device(), contents, {}, {.contacts = 4}),
         roomy = World::create(engine_test::device(), contents);
    ASSERT_TRUE(tight && enough && roomy);
    expectNoRoom(**tight, "finds 4 contacts, there is room for 3; raise the budget of contacts");
    run(**enough, 4);
    run(**roomy, 4);
    EXPECT_EQ(hashOf(**enough), hashOf(**roomy));
}

TEST(World, WithoutContactsBodiesFallThroughEachOther) {
    StepSettings settings;
    settings.contacts = false;
    settings.sleeping = true;
    auto world = World::create(engine_test::device(), tower(3, 0.9), settings);
    ASSERT_TRUE(world);
    run(**world, 60);
    const auto bodies = (*world)->bodies();
    ASSERT_TRUE(bodies);
    for (uint32_t k = 0; k < 3; ++k)
        EXPECT_NEAR((*bodies)[k].offset.y, 0.9 * k - 9.81 / 2, 1e-4);
    EXPECT_EQ(countsOf(**world).pairs, 0u);
}

// Seven passes over the contacts of a stack carry its load sooner than one: it sinks into its soft contacts more slowly.
TEST(World, MoreIterationsCarryAStackSooner) {
    const auto speedAfter = [](uint32_t iterations) {
        brittle::SceneDescription scene = *brittle::makeBuiltinScene("stack_20");
        scene.step.iterations = iterations;
        scene.step.most_substeps = scene.step.substeps;
        support::SceneRun stack(scene);
        stack.step(5);
        return stack.fastest();
    };
    const double once = speedAfter(1), often = speedAfter(7);
    EXPECT_GT(once, 0);
    EXPECT_LT(often, 0.7 * once);
}

// Two crowds of sixty boxes each fly into each other: then there are more pairs than there is room for at first.
WorldContents crowds() {
    WorldContents contents;
    for (int k = 0; k < 120; ++k) {
        const double side = k < 60 ? -1 : 1;
        BodyDefinition body = support::box({1, 1, 1}, {0.001 * k, 0.002 * (k % 7), 4 * side});
        body.velocity = {0, 0, -60 * side};
        EXPECT_TRUE(brittle::addBody(contents, body));
    }
    return contents;
}

TEST(World, MakesRoomForMorePairsAndGoesOnAsIfItHadHadIt) {
    const WorldContents contents = crowds();
    auto grown = World::create(engine_test::device(), contents),
         roomy = World::create(engine_test::device(), contents, {}, {.pairs = 20000});
    ASSERT_TRUE(grown && roomy);
    run(**grown, 2);
    EXPECT_LT(countsOf(**grown).pairs, 4000u);
    run(**roomy, 2);
    for (const auto& world : {grown->get(), roomy->get()})
        run(*world, 2);
    EXPECT_GT(countsOf(**grown).pairs, 4000u);
    EXPECT_EQ(hashOf(**grown), hashOf(**roomy));
}

// The last of them are on the device already by the time that the host learns that one before them did not fit.
TEST(World, MakesRoomInTheMiddleOfManyStepsAsBetweenSingleOnes) {
    const WorldContents contents = crowds();
    const auto together = worldOf(contents), singly = worldOf(contents);
    run(*together, 9);
    uint32_t most = 0;
    for (int k = 0; k < 9; ++k) {
        run(*singly, 1);
        most = std::max(most, countsOf(*singly).pairs);
    }
    EXPECT_GT(most, 4000u);
    EXPECT_EQ(hashOf(*together), hashOf(*singly));
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
