// How two motions are compared: passes, elements of buffers, bodies; and that a device agrees with itself.
#include "modules/brittle/comparison/buffer_difference.h"
#include "modules/brittle/comparison/motion_difference.h"
#include "modules/brittle/comparison/pass_alignment.h"
#include "modules/brittle/comparison/world_comparison.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/engine/test_device.h"
#include "tests/module/breaking_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

using brittle::BufferContents;
using brittle::DifferenceKind;
using brittle::matchElements;
using brittle::World;

namespace {

using Words = std::vector<uint32_t>;

BufferContents contentsOf(const Words& before, const Words& after) {
    return {std::as_bytes(std::span(before)), std::as_bytes(std::span(after))};
}

brittle::CapturedBuffer bufferOf(const std::string& slot, const Words& after) {
    brittle::CapturedBuffer buffer = {slot, slot};
    const auto bytes = std::as_bytes(std::span(after));
    buffer.before.assign(bytes.size(), std::byte{0});
    buffer.after.assign(bytes.begin(), bytes.end());
    return buffer;
}

struct Classified {
    bool is_row = false;
    brittle::BufferDifference row;
};
Classified classified(const std::string& slot, const Words (&a)[2], const Words (&b)[2]) {
    const brittle::CapturedBuffer buffers[] = {bufferOf(slot, a[0]), bufferOf(slot, a[1]), bufferOf(slot, b[0]),
                                               bufferOf(slot, b[1])};
    Classified found;
    found.is_row = brittle::classify({buffers[0], &buffers[1]}, {buffers[2], &buffers[3]}, found.row);
    return found;
}

gpu::BodyState bodyAt(int sector, float x) {
    gpu::BodyState body = {};
    body.sector = {sector, 0, 0, 0};
    body.offset = {x, 0, 0, 1};
    body.turn = {0, 0, 0, 1};
    return body;
}

void expectAgreesWithItself(World& first, World& second, uint32_t steps) {
    const auto found =
        brittle::compareWorlds({engine_test::device(), first}, {engine_test::device(), second}, {.steps = steps});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->steps, steps);
    EXPECT_FALSE(found->first_difference);
    EXPECT_EQ(found->motion.position_m, 0);
    EXPECT_GT(found->motion.bodies, 0u);
    // No pass of the next step differs, either.
    const auto state = first.save();
    ASSERT_TRUE(state);
    const auto step = brittle::compareStep({engine_test::device(), first}, {engine_test::device(), second}, *state, *state);
    ASSERT_TRUE(step) << step.error().message;
    EXPECT_GT(step->aligned, 20u);
    EXPECT_EQ(step->aligned, step->passes_a);
    const brittle::BufferDifference* finding = step->finding();
    EXPECT_EQ(finding, nullptr) << finding->kernel_a << " " << finding->slot << " "
                                << (finding->first ? finding->first->member : "");
}

std::unique_ptr<World> builtinWorld(const std::string& name) {
    const auto scene = brittle::makeBuiltinScene(name);
    EXPECT_TRUE(scene) << scene.error().message;
    return breaking_scenes::worldOf(*scene);
}

} // namespace

TEST(SmallComparison, ComparesElementsThatEitherDeviceChanged) {
    const Words before = {0, 0, 9, 5}, a = {1, 2, 9, 5}, other_before = {0, 0, 8, 0}, b = {1, 3, 8, 5};
    const auto match = matchElements(contentsOf(before, a), contentsOf(other_before, b), 4);
    EXPECT_EQ(match.written, 3u); // the third was left alone by both
    EXPECT_EQ(match.only_a, (std::vector<uint64_t>{1}));
    EXPECT_EQ(match.only_b, (std::vector<uint64_t>{1}));
}

TEST(SmallComparison, TakesAnotherOrderForNoDifference) {
    const Words before(6), a = {1, 1, 2, 2, 3, 3}, b = {3, 3, 2, 2, 1, 4};
    const auto match = matchElements(contentsOf(before, a), contentsOf(before, b), 8);
    EXPECT_EQ(match.moved, 1u);
    EXPECT_EQ(match.only_a, (std::vector<uint64_t>{0})); // 1, 1
    EXPECT_EQ(match.only_b, (std::vector<uint64_t>{2})); // 1, 4
}

TEST(SmallComparison, SaysWhyBuffersDiffer) {
    const Words sound = {1, 2, 3}, faulty = {1, 2, 4}, turned = {3, 2, 1}, unstable = {1, 7, 3};
    EXPECT_FALSE(classified("list", {sound, sound}, {sound, sound}).is_row);
    const Classified differs = classified("list", {sound, sound}, {faulty, faulty});
    EXPECT_EQ(differs.row.kind, DifferenceKind::Differs);
    ASSERT_TRUE(differs.row.first);
    EXPECT_EQ(differs.row.first->element_a, 2u);
    EXPECT_EQ(differs.row.first->a, "3");
    EXPECT_EQ(differs.row.first->b, "4");
    EXPECT_EQ(classified("list", {sound, sound}, {turned, turned}).row.kind, DifferenceKind::Reordered);
    EXPECT_TRUE(brittle::isUnordered(bufferOf("loose_list", sound)));
    EXPECT_TRUE(brittle::isUnordered(bufferOf("edge_table", sound)));
    EXPECT_FALSE(brittle::isUnordered(bufferOf("bodies", sound)));
    EXPECT_EQ(classified("list", {sound, unstable}, {unstable, sound}).row.kind, DifferenceKind::Unstable);
    // An element that a device does not repeat hides no difference in another element.
    const Classified both = classified("list", {sound, unstable}, {faulty, faulty});
    EXPECT_EQ(both.row.kind, DifferenceKind::Differs);
    EXPECT_EQ(both.row.first->element_a, 2u);
}

TEST(SmallComparison, AlignsPassesThatBothDevicesMake) {
    const std::vector<std::string> a = {"open", "sort", "pair", "solve", "solve", "end"},
                                   b = {"open", "count", "scatter", "pair", "solve", "end"};
    using Pair = std::pair<uint32_t, uint32_t>;
    EXPECT_EQ(brittle::alignKeys(a, b), (std::vector<Pair>{{0, 0}, {2, 3}, {4, 4}, {5, 5}}));
    EXPECT_EQ(brittle::alignKeys(a, a).size(), a.size());
    EXPECT_TRUE(brittle::alignKeys(a, {}).empty());
}

TEST(SmallComparison, TakesVersionsForWideSubgroupsForTheSameKernel) {
    const brittle::Pass narrow = {"solve", "solve_contacts"}, wide = {"solve", "solve_contacts_wide"},
                        other = {"end", "solve_contacts"};
    EXPECT_EQ(brittle::keyOf(narrow), brittle::keyOf(wide));
    EXPECT_NE(brittle::keyOf(narrow), brittle::keyOf(other));
}

TEST(SmallComparison, MeasuresHowFarBodiesAreApart) {
    std::vector<gpu::BodyState> a = {bodyAt(0, 7.5f), bodyAt(0, 0), bodyAt(0, 0)},
                                b = {bodyAt(1, -7.5f), bodyAt(0, 0), bodyAt(0, 0)};
    const double angle = 0.02;
    b[1].turn = {0, static_cast<float>(std::sin(angle / 2)), 0, static_cast<float>(std::cos(angle / 2))};
    b[1].velocity = {3, 4, 0, 0};
    b[2].sector.w = BODY_ABSENT;
    const auto motion = brittle::motionDifference(a, b);
    EXPECT_DOUBLE_EQ(motion.position_m, 1);
    EXPECT_EQ(motion.body, 0u);
    EXPECT_NEAR(motion.rotation_rad, angle, 1e-8);
    EXPECT_DOUBLE_EQ(motion.linear_velocity, 5);
    EXPECT_EQ(motion.bodies, 2u);
    EXPECT_EQ(motion.only_a, 1u);
    EXPECT_EQ(motion.only_b, 0u);
    for (float* number : {&b[1].turn.x, &b[1].turn.y, &b[1].turn.z, &b[1].turn.w})
        *number = -*number; // the same rotation
    EXPECT_NEAR(brittle::motionDifference(a, b).rotation_rad, angle, 1e-8);
}

TEST(SmallComparison, NamesTheFirstNumberOfABodyThatDiffers) {
    std::vector<gpu::BodyState> a = {bodyAt(0, 1), bodyAt(0, 2)}, b = a;
    EXPECT_FALSE(brittle::firstBodyDifference(a, b));
    b[1].velocity.y = 0.5f;
    const auto difference = brittle::firstBodyDifference(a, b);
    ASSERT_TRUE(difference);
    EXPECT_EQ(difference->body, 1u);
    EXPECT_EQ(difference->member, "velocity.y");
    EXPECT_EQ(difference->a, "0");
    EXPECT_EQ(difference->b, "0.5");
}

TEST(Comparison, FindsNothingBetweenADeviceAndItselfInAPile) {
    const auto first = builtinWorld("hull_pile_100"), second = builtinWorld("hull_pile_100");
    expectAgreesWithItself(*first, *second, 20);
}

TEST(Comparison, FindsNothingBetweenADeviceAndItselfInTheStepThatBreaks) {
    const auto scene = breaking_scenes::shot(30, "glass");
    const auto scout = breaking_scenes::worldOf(scene);
    uint32_t before = 0;
    for (; before < 60; ++before) {
        breaking_scenes::step(*scout);
        const auto breaks = scout->breaks();
        ASSERT_TRUE(breaks);
        if (!breaks->events.empty()) break;
    }
    ASSERT_LT(before, 60u);
    const auto first = breaking_scenes::worldOf(scene), second = breaking_scenes::worldOf(scene);
    expectAgreesWithItself(*first, *second, before);
}

TEST(Comparison, AProbedStepIsTheSameStep) {
    const auto probed = builtinWorld("stack_10"), stepped = builtinWorld("stack_10");
    breaking_scenes::step(*probed, 3);
    const auto state = probed->save();
    ASSERT_TRUE(state);
    ASSERT_TRUE(brittle::captureHashes({engine_test::device(), *probed}, *state));
    breaking_scenes::step(*stepped, 4);
    EXPECT_EQ(*probed->hash(), *stepped->hash());
}
