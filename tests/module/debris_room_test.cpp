// Where room for fragments runs short, the smallest and oldest at rest leave the world: the effect `debris_room`.
#include "tests/module/small_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

namespace {

using breaking_scenes::massOf, breaking_scenes::presentBodies, breaking_scenes::step, breaking_scenes::worldOf;
using small_pieces::countsOf;

constexpr uint32_t kCubes = 12;

// Glass cubes side by side on the floor, to be broken one after the other.
brittle::SceneDescription rowOfCubes(bool makes_room) {
    std::vector<brittle::BodyDescription> cubes;
    for (uint32_t k = 0; k < kCubes; ++k) {
        brittle::BodyDescription& cube = cubes.emplace_back();
        cube.shape.size = {0.2, 0.2, 0.2};
        cube.place = {1.0 * k, 0.1, 0};
        cube.material = "glass";
    }
    std::vector<std::string> effects = {"events", "sleeping", "refracture"};
    if (makes_room) effects.emplace_back("debris_room");
    return small_pieces::sceneOf(std::move(cubes), effects);
}

brittle::WorldBudget budgetOf(uint32_t fragments) {
    brittle::WorldBudget budget;
    budget.breaking.fragments = fragments;
    return budget;
}

using Who = std::array<uint32_t, 2>; // slot, the step that it was made in

struct Told {
    std::vector<uint32_t> fragments; // of each cube that broke
    std::vector<Who> gone;
};

void listen(brittle::World& world, Told& told) {
    const auto breaks = world.breaks();
    ASSERT_TRUE(breaks) << breaks.error().message;
    EXPECT_EQ(breaks->lost, 0u);
    for (const gpu::BreakEvent& event : breaks->events) {
        if (event.made.y == WHOLE_GONE) told.gone.push_back({event.what.y, event.born.x});
        if (event.made.y == 0 && event.born.x == 0) told.fragments.push_back(event.made.x);
    }
}

Told breakOneAfterTheOther(brittle::World& world) {
    Told told;
    for (uint32_t k = 0; k < kCubes; ++k) {
        EXPECT_TRUE(world.strike({{1.0 * k, 0.2, 0}, 0.05, 200}));
        for (uint32_t turn = 0; turn < 12; ++turn) {
            step(world, 10);
            listen(world, told);
        }
    }
    return told;
}

TEST(DebrisRoom, IsMadeForBodiesThatBreakLater) {
    const auto world = worldOf(rowOfCubes(true), budgetOf(128));
    const Told told = breakOneAfterTheOther(*world);
    ASSERT_EQ(told.fragments.size(), kCubes);
    EXPECT_GT(*std::ranges::min_element(told.fragments), 8u) << "more than the few that are kept for each";
    const auto counts = countsOf(*world);
    EXPECT_GT(counts.expired, 60u);
    EXPECT_EQ(counts.pool_faults, 0u);
    EXPECT_EQ(told.gone.size(), counts.expired) << "each is reported";
    EXPECT_EQ(std::set<Who>(told.gone.begin(), told.gone.end()).size(), told.gone.size()) << "once";
}

TEST(DebrisRoom, WithoutItBodiesBreakIntoTheFewThatAreKeptForThem) {
    const auto world = worldOf(rowOfCubes(false), budgetOf(128));
    const Told told = breakOneAfterTheOther(*world);
    ASSERT_EQ(told.fragments.size(), kCubes);
    EXPECT_LE(*std::ranges::min_element(told.fragments), 8u);
    EXPECT_EQ(countsOf(*world).expired, 0u);
    EXPECT_TRUE(told.gone.empty());
}

// Fragments have been at rest for two seconds when the next cube breaks. Classes are octaves of volume.
TEST(DebrisRoom, IsMadeByTheSmallest) {
    const auto world = worldOf(rowOfCubes(true), budgetOf(128));
    std::vector<brittle::BodyFragment> before;
    for (uint32_t k = 0; k < kCubes && countsOf(*world).expired == 0; ++k) {
        ASSERT_TRUE(world->strike({{1.0 * k, 0.2, 0}, 0.05, 200}));
        for (uint32_t turn = 0; turn < 120 && countsOf(*world).expired == 0; ++turn) {
            before = *world->fragments();
            step(*world);
        }
    }
    ASSERT_GT(countsOf(*world).expired, 0u);
    std::set<Who> stayed;
    const auto fragments = world->fragments();
    for (const brittle::BodyFragment& fragment : *fragments)
        stayed.insert({fragment.slot, static_cast<uint32_t>(fragment.record.balance.w)});
    double largest_gone = 0, smallest_stayed = 1e9;
    const uint64_t now = 120 * kCubes;
    for (const brittle::BodyFragment& fragment : before) {
        const auto born = static_cast<uint32_t>(fragment.record.balance.w);
        const double volume = fragment.record.form.x;
        if (!stayed.contains({fragment.slot, born}))
            largest_gone = std::max(largest_gone, volume);
        else if (born + 240 < now)
            smallest_stayed = std::min(smallest_stayed, volume);
    }
    EXPECT_GT(largest_gone, 0);
    EXPECT_LT(largest_gone, 2 * smallest_stayed);
}

TEST(DebrisRoom, ChangesNothingWhereThereIsRoom) {
    const auto with = worldOf(rowOfCubes(true), budgetOf(4096)), without = worldOf(rowOfCubes(false), budgetOf(4096));
    for (brittle::World* world : {with.get(), without.get()}) {
        ASSERT_TRUE(world->strike({{0, 0.2, 0}, 0.05, 200}));
        step(*world, 120);
    }
    EXPECT_EQ(countsOf(*with).expired, 0u);
    EXPECT_GT(countsOf(*with).fragments, 10u);
    EXPECT_EQ(*with->hash(), *without->hash());
}

TEST(DebrisRoom, IsMadeTheSameInGroupsOfAnySize) {
    std::set<uint64_t> hashes;
    for (const uint32_t lanes : {8u, 64u}) {
        brittle::WorldBudget budget = budgetOf(128);
        budget.group_size = lanes;
        const auto world = worldOf(rowOfCubes(true), budget);
        const Told told = breakOneAfterTheOther(*world);
        EXPECT_FALSE(told.gone.empty());
        hashes.insert(*world->hash());
    }
    EXPECT_EQ(hashes.size(), 1u);
}

TEST(DebrisRoom, CostsNothingWhereItIsOff) {
    const auto on = worldOf(rowOfCubes(true))->plan(), off = worldOf(rowOfCubes(false))->plan();
    ASSERT_TRUE(on && off);
    EXPECT_GT(on->bytesOf(brittle::Effect::DebrisRoom), 0u);
    EXPECT_EQ(off->bytesOf(brittle::Effect::DebrisRoom), 0u);
    for (const char* kernel : {"age_debris", "make_room", "list_debris", "tell_gone", "wake_debris", "expire_debris"}) {
        EXPECT_EQ(std::ranges::count(on->passes, kernel, &brittle::Pass::kernel), 1) << kernel;
        EXPECT_EQ(std::ranges::count(off->passes, kernel, &brittle::Pass::kernel), 0) << kernel;
    }
}

} // namespace
