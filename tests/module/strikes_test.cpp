// Tests which bodies a host breaks by hand, where, and by how much energy. The expected place and mass come from boxes and
// Newton's laws in double precision.
#include "modules/brittle/dynamics/pose.h"
#include "tests/module/breaking_scenes.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace {

using namespace breaking_scenes;
using brittle::BodyDescription, brittle::HandBlow;
using Eigen::Vector3d, Eigen::Matrix3d, Eigen::Quaterniond;

constexpr double kDensity = 2500; // kg/m3

BodyDescription block(const Vector3d& size, const Vector3d& place, const Quaterniond& turn = Quaterniond::Identity()) {
    BodyDescription body;
    body.material = "glass";
    body.density = kDensity;
    body.shape.size = {size.x(), size.y(), size.z()};
    body.place = {place.x(), place.y(), place.z()};
    body.turn = {turn.x(), turn.y(), turn.z(), turn.w()};
    return body;
}

std::unique_ptr<brittle::World> inEmptySpace(std::vector<BodyDescription> bodies) {
    brittle::SceneDescription scene = sceneOf(std::move(bodies), false);
    scene.effects = {"contacts", "impact_fracture", "events"};
    return worldOf(scene);
}

std::vector<gpu::BreakEvent> breaksOf(brittle::World& world, const std::vector<HandBlow>& blows) {
    for (const HandBlow& blow : blows)
        EXPECT_TRUE(world.strike(blow));
    return stepUntilItBreaks(world, 2);
}

Vector3d vectorIn(const gpu::vec4& v) { return {v.x, v.y, v.z}; }
Vector3d placeOf(const gpu::BreakEvent& event) {
    return 16 * Vector3d(event.sector.x, event.sector.y, event.sector.z) + vectorIn(event.offset);
}

// How a blow meets a turned box.
struct Meeting {
    Vector3d place, along; // the nearest place of the box; from there to the blow
    double mass = 0;       // of the box and of a ball of the same density that meet there
};

Meeting meetingOf(const Vector3d& size, const Vector3d& middle, const Quaterniond& turn, const HandBlow& blow) {
    const Vector3d from(blow.place[0], blow.place[1], blow.place[2]);
    const Matrix3d axes = turn.toRotationMatrix();
    const Vector3d inside = (axes.transpose() * (from - middle)).cwiseMax(-size / 2).cwiseMin(size / 2);
    const Vector3d arm = axes * inside, along = (from - middle - arm).normalized();
    const double mass = kDensity * size.prod(), ball = kDensity * 4 / 3 * std::numbers::pi * std::pow(blow.radius, 3);
    const Vector3d squares = size.cwiseProduct(size);
    const Vector3d moments = mass / 12 * (Vector3d::Constant(squares.sum()) - squares);
    const Matrix3d inverse = axes * moments.cwiseInverse().asDiagonal() * axes.transpose();
    const double turning = (inverse * arm.cross(along)).cross(arm).dot(along);
    return {middle + arm, along, 1 / (1 / ball + 1 / mass + turning)};
}

// A corner, an edge, and a side, each of them off the middle.
const HandBlow kBlows[] = {{{0.4, 20.25, 0.1}, 0.32, 4000}, {{0.12, 20.3, -0.02}, 0.25, 3000}, {{0.03, 19.8, 0.05}, 0.2, 2000}};
const Vector3d kSize(0.3, 0.2, 0.1), kMiddle(0.02, 20, 0.01);
const Quaterniond kTurn = Quaterniond(0.9, 0.2, 0.3, 0.25).normalized();

void expectBrokenAt(const BodyDescription& body, const HandBlow& blow) {
    const auto events = breaksOf(*inEmptySpace({body}), {blow});
    ASSERT_EQ(events.size(), 1u);
    const Meeting expected = meetingOf(kSize, kMiddle, kTurn, blow);
    EXPECT_EQ(events[0].what.z, uint32_t{NO_INDEX}) << "by hand";
    EXPECT_GT(events[0].made.x, 1u);
    EXPECT_LT((placeOf(events[0]) - expected.place).norm(), 1e-5);
    EXPECT_LT((vectorIn(events[0].along) - expected.along).norm(), 1e-3);
    EXPECT_NEAR(events[0].blow.x / expected.mass, 1, 1e-3);
    EXPECT_NEAR(events[0].blow.y / std::sqrt(2 * blow.energy / expected.mass), 1, 1e-3);
}

TEST(SmallStrikes, MeetABodyAtItsNearestPlaceAsABallOfItsDensityWould) {
    for (const HandBlow& blow : kBlows)
        expectBrokenAt(block(kSize, kMiddle, kTurn), blow);
}

TEST(SmallStrikes, MeetTheNearestOfManyPiecesOfABody) {
    BodyDescription body = block(kSize, kMiddle, kTurn);
    body.shape.cells.sites = 12;
    for (const HandBlow& blow : kBlows)
        expectBrokenAt(body, blow);
}

std::vector<uint32_t> brokenBy(const std::vector<HandBlow>& blows) {
    const Vector3d size = Vector3d::Constant(0.2);
    const auto world = inEmptySpace({block(size, {0, 0, 0}), block(size, {0.5, 0, 0}), block(size, {1, 0, 0})});
    std::vector<uint32_t> bodies;
    for (const gpu::BreakEvent& event : breaksOf(*world, blows))
        bodies.push_back(event.what.y);
    std::ranges::sort(bodies);
    return bodies;
}

TEST(SmallStrikes, ReachWhatIsNoFurtherThanTheirRadius) {
    using Bodies = std::vector<uint32_t>;
    EXPECT_EQ(brokenBy({{{0.2, 0, 0}, 0.099, 1e4}}), Bodies{});
    EXPECT_EQ(brokenBy({{{0.2, 0, 0}, 0.101, 1e4}}), Bodies{0});
    EXPECT_EQ(brokenBy({{{0.25, 0, 0}, 0.151, 1e4}}), (Bodies{0, 1}));
    EXPECT_EQ(brokenBy({{{1.2, 0, 0}, 0.101, 1e4}, {{-0.2, 0, 0}, 0.101, 1e4}}), (Bodies{0, 2}));
}

TEST(SmallStrikes, ShareTheirEnergyEvenlyAmongAllThatTheyReachAndCanBreak) {
    const Vector3d size = Vector3d::Constant(0.2);
    std::vector<BodyDescription> bodies = {block(size, {0, 0, 0}), block(size, {0.5, 0, 0}), block(size, {0.25, 0.3, 0})};
    bodies[2].material = "";
    const auto events = breaksOf(*inEmptySpace(bodies), {{{0.25, 0, 0}, 0.21, 900}});
    ASSERT_EQ(events.size(), 2u);
    for (const gpu::BreakEvent& event : events)
        EXPECT_NEAR(event.blow.x * event.blow.y * event.blow.y / 2, 450, 0.01);
}

TEST(SmallStrikes, BreakABodyByTheHardestOfThem) {
    const Vector3d size = Vector3d::Constant(0.2);
    const HandBlow soft{{-0.15, 0, 0}, 0.06, 100}, hard{{0.15, 0, 0}, 0.06, 400};
    for (const auto& blows : {std::vector{soft, hard}, std::vector{hard, soft}}) {
        const auto events = breaksOf(*inEmptySpace({block(size, {0, 0, 0})}), blows);
        ASSERT_EQ(events.size(), 1u);
        EXPECT_NEAR(events[0].offset.x, 0.1, 1e-5);
    }
}

// A contact that would break a body breaks it no more if a blow by hand is harder.
TEST(Strikes, WeighAgainstContacts) {
    for (const double energy : {50.0, 5000.0}) {
        brittle::SceneDescription scene = shot(20, "glass"); // 400 J at most
        const auto probe = worldOf(scene);
        uint32_t steps = 0;
        while (steps < 20 && stepUntilItBreaks(*probe, 1).empty())
            ++steps;
        const auto world = worldOf(scene);
        step(*world, steps);
        const auto events = breaksOf(*world, {{{0.15, 0, 0}, 0.06, energy}});
        ASSERT_EQ(events.size(), 1u);
        EXPECT_EQ(events[0].what.z == NO_INDEX, energy > 1000) << energy;
    }
}

// The plate lies on the cube, and both sleep.
TEST(SmallStrikes, WakeWhatRestedOnABodyThatBreaks) {
    brittle::SceneDescription scene =
        sceneOf({block(Vector3d::Constant(0.2), {0, 0.1, 0}), block({0.4, 0.02, 0.4}, {0, 0.21, 0})});
    scene.effects.emplace_back("sleeping");
    scene.bodies[1].material = "";
    const auto world = worldOf(scene);
    const auto sleeps = [&] { return ((*world->bodies())[1].sector.w & BODY_ASLEEP) != 0; };
    for (uint32_t k = 0; k < 20 && !sleeps(); ++k)
        step(*world, 15);
    ASSERT_TRUE(sleeps());
    ASSERT_EQ(breaksOf(*world, {{{0.15, 0.1, 0}, 0.06, 2000}}).size(), 1u);
    EXPECT_FALSE(sleeps());
    EXPECT_LT((*world->bodies())[1].velocity.w, 0.1f) << "it counts again how long it has hardly moved";
}

// A row of cubes without contact, and one blow that reaches all of them.
struct StruckRow {
    std::unique_ptr<brittle::World> world;
    uint32_t count;
    std::vector<gpu::BreakEvent> told;

    StruckRow(uint32_t cubes, uint32_t at_once, const std::array<double, 3>& spin = {0, 0, 0}) : count(cubes) {
        std::vector<BodyDescription> bodies;
        for (uint32_t k = 0; k < cubes; ++k) {
            bodies.push_back(block(Vector3d::Constant(0.2), {0.4 * k, 0, 0}));
            bodies.back().spin = spin;
        }
        brittle::SceneDescription scene = sceneOf(std::move(bodies), false);
        scene.effects = {"contacts", "impact_fracture", "events"};
        brittle::WorldBudget budget;
        budget.breaking.step_bodies = at_once;
        budget.breaking.most_fragments = at_once != 0 ? 20 : 0; // so that the world has room for all
        world = worldOf(scene, budget);
    }
    void strike(double energy_of_each) const {
        EXPECT_TRUE(world->strike({{0.2 * (count - 1), 0.11, 0}, 4, energy_of_each * count}));
    }
    size_t step() {
        const size_t before = told.size();
        breaking_scenes::step(*world);
        const auto breaks = world->breaks();
        EXPECT_TRUE(breaks);
        told.insert(told.end(), breaks->events.begin(), breaks->events.end());
        return told.size() - before;
    }
};

TEST(Strikes, ReachBodiesForWhichAStepHasNoRoomInTheStepsAfter) {
    StruckRow row(7, 2);
    row.strike(400);
    const size_t in_order[] = {2, 2, 2, 1, 0, 0};
    for (const size_t expected : in_order)
        EXPECT_EQ(row.step(), expected);
    std::vector<uint32_t> broken;
    for (const gpu::BreakEvent& event : row.told) {
        broken.push_back(event.what.y);
        EXPECT_EQ(event.what.z, uint32_t{NO_INDEX}) << "by hand";
        EXPECT_GT(event.made.x, 1u);
        EXPECT_NEAR(event.blow.x * event.blow.y * event.blow.y / 2, 400, 0.01);
    }
    EXPECT_EQ(broken, (std::vector<uint32_t>{0, 1, 2, 3, 4, 5, 6}));
}

// 3000 J ask for more pieces of three cubes than a step makes.
TEST(Strikes, BreakAllTheyReachWithTheDefaultBudgets) {
    StruckRow row(3, 0);
    row.strike(3000);
    for (uint32_t k = 0; k < 4; ++k)
        row.step();
    EXPECT_EQ(row.told.size(), 3u);
}

// The last cubes wait for several steps, and turn meanwhile. What is told stands where the body is when its step has ended.
TEST(Strikes, ThatWaitStayAtThePlaceOfTheBodyThatTheyHit) {
    StruckRow still(4, 1), turning(4, 1, {0, 0, 9});
    for (StruckRow* row : {&still, &turning}) {
        row->strike(400);
        for (uint32_t k = 0; k < 5; ++k)
            row->step();
        ASSERT_EQ(row->told.size(), 4u);
    }
    for (uint32_t k = 0; k < 4; ++k) {
        const Vector3d middle(0.4 * k, 0, 0), arm = placeOf(still.told[k]) - middle;
        const Vector3d turned = Eigen::AngleAxisd(9 * (k + 1) / 60.0, Vector3d::UnitZ()) * arm;
        EXPECT_LT((placeOf(turning.told[k]) - middle - turned).norm(), 1e-4) << k;
    }
}

TEST(Strikes, ThatWaitAreNotSaved) {
    StruckRow row(3, 1);
    row.strike(400);
    EXPECT_EQ(row.step(), 1u);
    const auto state = row.world->save();
    ASSERT_TRUE(state);
    EXPECT_EQ(row.step(), 1u);
    ASSERT_TRUE(row.world->restore(*state));
    EXPECT_EQ(row.step() + row.step(), 0u);
}

} // namespace
