// Events of worlds: who is told of them, and when they are lost.
#include "tests/abi/heap.h"
#include "tests/abi/hosting.h"

namespace {

using namespace abi_test;

// Balls in rows that bounce: more impacts than a device keeps.
Scene manyThatBounce(const Hosting& host) {
    std::vector<BrittleBodyDef> balls(400, brittleDefaultBodyDef());
    for (size_t k = 0; k < balls.size(); ++k) {
        balls[k].shape.kind = BRITTLE_SHAPE_BALL;
        balls[k].position = {2.0 * static_cast<double>(k % 20), 0.52, 2.0 * static_cast<double>(k / 20)};
        balls[k].velocity.y = -3;
        balls[k].restitution = 0.9;
    }
    BrittleWorldDef def = brittleDefaultWorldDef();
    def.gravity.y = -60;
    return makeScene(host, balls, def);
}

constexpr int kSteps = 60;

uint32_t impactsOf(const Hosting& host, BrittleWorld world) {
    std::vector<BrittleImpact> impacts(65536);
    uint32_t count = 0;
    EXPECT_EQ(brittleGetImpacts(host, world, impacts.data(), 65536, &count), BRITTLE_OK) << host.error();
    return count;
}

// As long as it asks; whether there is memory for them or not.
TEST(AbiEvents, AreNotLostWhereTheHostHasNoMemoryForLong) {
    Heap heap;
    {
        const Hosting host({}, heap.allocator());
        const Scene scene = manyThatBounce(host), again = manyThatBounce(host);
        uint32_t told = 0, count = 0;
        for (int k = 0; k < kSteps; ++k) {
            MUST(host, brittleStep(host, scene.world, 1));
            told += impactsOf(host, scene.world);
        }
        EXPECT_GT(told, 1024u);
        heap.most = heap.allocations;
        BrittleImpact one;
        for (int k = 0; k < kSteps; ++k) {
            ASSERT_EQ(brittleStep(host, again.world, 1), BRITTLE_OK);
            const BrittleResult asked = brittleGetImpacts(host, again.world, &one, 0, &count);
            EXPECT_TRUE(asked == BRITTLE_OK || asked == BRITTLE_OUT_OF_MEMORY) << brittleResultName(asked);
        }
        heap.most = ~size_t{0};
        EXPECT_EQ(impactsOf(host, again.world), told);
        EXPECT_EQ(countsOf(host, again.world).impacts_lost, 0u);
    }
    EXPECT_TRUE(heap.blocks.empty());
}

TEST(AbiEvents, ThatAreLostAreCountedBeforeAnybodyAsks) {
    const Hosting host;
    const Scene scene = manyThatBounce(host), again = manyThatBounce(host);
    uint32_t told = 0;
    for (int k = 0; k < kSteps; ++k) {
        MUST(host, brittleStep(host, scene.world, 1));
        told += impactsOf(host, scene.world);
    }
    MUST(host, brittleStep(host, again.world, kSteps));
    EXPECT_EQ(countsOf(host, again.world).impacts_lost, told - 1024);
    EXPECT_EQ(impactsOf(host, again.world), 1024u);
    EXPECT_EQ(countsOf(host, again.world).impacts_lost, told - 1024);
    const Scene third = manyThatBounce(host);
    const std::vector<std::byte> beginning = savedOf(host, third.world);
    MUST(host, brittleStep(host, third.world, kSteps));
    MUST(host, brittleRestoreState(host, third.world, beginning.data(), beginning.size()));
    EXPECT_EQ(countsOf(host, third.world).impacts_lost, told - 1024) << "what was lost before the time was taken back is lost";
    EXPECT_EQ(impactsOf(host, third.world), 0u);
}

// Of the time before it nothing is told after it, whatever had been asked when the state was saved.
TEST(AbiEvents, AreForgottenWhereAStateIsRestored) {
    const Hosting host;
    for (const bool asks_before : {false, true}) {
        const Scene scene = makeScene(host, {glassCube(host, 1), glassCube(host, 3)});
        MUST(host, brittleDamage(host, scene.world, {0, 1, 0}, 0.2, 1000));
        MUST(host, brittleStep(host, scene.world, 1));
        EXPECT_EQ(asks_before ? breaksOf(host, scene.world).size() : 1, 1u);
        const std::vector<std::byte> state = savedOf(host, scene.world);
        MUST(host, brittleDamage(host, scene.world, {0, 3, 0}, 0.2, 1000));
        MUST(host, brittleStep(host, scene.world, 1));
        MUST(host, brittleRestoreState(host, scene.world, state.data(), state.size()));
        EXPECT_TRUE(breaksOf(host, scene.world).empty()) << asks_before;
        MUST(host, brittleDamage(host, scene.world, {0, 3, 0}, 0.2, 1000));
        MUST(host, brittleStep(host, scene.world, 1));
        EXPECT_EQ(breaksOf(host, scene.world).size(), 1u) << "what comes after it is told";
        EXPECT_EQ(countsOf(host, scene.world).breaks_lost, 0u);
    }
}

} // namespace
