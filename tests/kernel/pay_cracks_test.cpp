// Cracks are paid for by the motion of the two bodies that met: pay_cracks, against mechanics in double precision.
#include "modules/brittle/effects/blow.h"
#include "shaders-spirv/shared/breaking.h"
#include "tests/kernel/solver_lab.h"

#include <cmath>

namespace kernel_test {
namespace {

constexpr float kPause = 0.25f;

struct Hit {
    gpu::BrokenBody broken{};
    Vector arm = {0, 0, 0};   // its place from the center of mass of what breaks, world axes
    Vector other = {0, 0, 0}; // and from the other body's
    double cracks = 0;
    bool refused = false;
};

struct Crash {
    std::vector<RigidBody> bodies;
    std::vector<Hit> hits; // one for each object that breaks
};

struct Paid {
    std::vector<gpu::BodyState> states;
    std::vector<gpu::BreakableBody> breakable;
    std::vector<gpu::CrackLedger> ledger;
};

Paid pay(const Crash& crash) {
    const auto count = static_cast<uint32_t>(crash.hits.size());
    std::vector<gpu::BrokenBody> hits;
    std::vector<float> areas;
    std::vector<Word4> lack;
    for (const Hit& hit : crash.hits) {
        hits.push_back(hit.broken);
        areas.push_back(static_cast<float>(hit.cracks));
        lack.push_back({0, 0, hit.refused ? 12u : 0u, 0});
    }
    Counts counts;
    counts[COUNT_BREAKING] = count;
    counts[COUNT_FRAGMENTS] = 5;
    const engine::Buffer broken = bufferOf(hits), cracks = bufferOf(areas), lacking = bufferOf(lack),
                         bodies = bufferOf(statesOf(crash.bodies)), shapes = bufferOf(shapesOf(crash.bodies)),
                         breakable = bufferOf(std::vector<gpu::BreakableBody>(crash.bodies.size())),
                         cards = bufferOf(std::vector{brittle::cardOf(*brittle::findMaterial("glass"))}),
                         steps = bufferOf(std::vector<uint32_t>{60, 0, 0, 0}), ledger = blankBuffer<gpu::CrackLedger>(count);
    const float push[] = {1.0f / 60, kPause};
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(kernel("pay_cracks"), count, push,
                          {counts.words, broken, cracks, lacking, bodies, shapes, breakable, cards, steps, ledger});
    });
    return {valuesOf<gpu::BodyState>(bodies, crash.bodies.size()), valuesOf<gpu::BreakableBody>(breakable, crash.bodies.size()),
            valuesOf<gpu::CrackLedger>(ledger, count)};
}

double fractureEnergy() { return brittle::findMaterial("glass")->fracture_energy; }

gpu::vec4 inOwnAxes(const RigidBody& body, const Vector& arm) {
    return wordsOf(Vector(turnOf(body.state.turn).conjugate() * arm));
}

// Two bodies that come together at a place, and one that breaks there.
Crash randomCrash(Chance& chance, bool other_moves) {
    Crash crash;
    crash.bodies = {randomBody(chance, true), randomBody(chance, other_moves)};
    const Vector way = crash.bodies[1].place() - crash.bodies[0].place(), arm = chance.inBox(0.4);
    Hit hit;
    hit.broken.ids = {0, 1, 0, 0};
    hit.arm = arm;
    hit.broken.place = inOwnAxes(crash.bodies[0], arm);
    hit.other = arm - way;
    const auto at = [&](const RigidBody& body, const Vector& r) -> Vector {
        return xyz(body.state.velocity) + xyz(body.state.spin).cross(r);
    };
    const Vector coming = at(crash.bodies[0], arm) - (other_moves ? at(crash.bodies[1], arm - way) : Vector(0, 0, 0));
    hit.broken.along = wordsOf((coming.normalized() + chance.inBox(0.3)).normalized());
    crash.hits = {hit};
    return crash;
}

struct Motion {
    double energy = 0;
    Vector momentum = {0, 0, 0}, angular = {0, 0, 0};
};

Motion motionOf(const Crash& crash, const std::vector<gpu::BodyState>& states) {
    Motion sum;
    for (size_t k = 0; k < states.size(); ++k) {
        if (states[k].offset.w == 0) continue;
        RigidBody body = crash.bodies[k];
        body.state = states[k];
        const double mass = 1.0 / states[k].offset.w;
        const Vector v = xyz(states[k].velocity), l = xyz(states[k].momentum);
        sum.energy += 0.5 * mass * v.squaredNorm() + 0.5 * l.dot(body.inverseInertia() * l);
        sum.momentum += mass * v;
        sum.angular += mass * body.place().cross(v) + l;
    }
    return sum;
}

// J, that the two can lose along the normal of the first hit.
double energyAtTheContact(const Crash& crash) {
    const Vector n = xyz(crash.hits[0].broken.along);
    double yield = 0, speed = 0;
    for (size_t k = 0; k < 2; ++k) {
        const RigidBody& body = crash.bodies[k];
        if (!body.moves()) continue;
        const Vector arm = k == 0 ? crash.hits[0].arm : crash.hits[0].other, lever = arm.cross(n);
        yield += double{body.state.offset.w} + lever.dot(body.inverseInertia() * lever);
        speed += (k == 0 ? 1 : -1) * n.dot(xyz(body.state.velocity) + xyz(body.state.spin).cross(arm));
    }
    return speed > 0 ? 0.5 * speed * speed / yield : 0;
}

TEST(Cracks, CostExactlyWhatTheyAreWorthAndNoMomentum) {
    Chance chance(5);
    for (uint32_t k = 0; k < 200; ++k) {
        Crash crash = randomCrash(chance, k % 3 != 0);
        crash.hits[0].cracks = std::exp(chance.between(std::log(1e-3), std::log(0.1)));
        const Paid paid = pay(crash);
        const Motion before = motionOf(crash, statesOf(crash.bodies)), after = motionOf(crash, paid.states);
        const double cost = fractureEnergy() * crash.hits[0].cracks;
        ASSERT_EQ(paid.ledger[0].outcome.x, 0u);
        EXPECT_NEAR(paid.ledger[0].energies.z, cost, 1e-5 * cost);
        const double due = std::min(cost, energyAtTheContact(crash));
        EXPECT_NEAR(before.energy - after.energy, due, 1e-3 * due + 4e-6 * before.energy) << k;
        if (k % 3 == 0) continue;
        EXPECT_LT((after.momentum - before.momentum).norm(), 1e-5 * (1 + before.momentum.norm())) << k;
        EXPECT_LT((after.angular - before.angular).norm(), 1e-4 * (1 + before.angular.norm())) << k;
    }
}

TEST(Cracks, TakeNoMoreThanThereIsAndTurnNobodyBack) {
    Chance chance(6);
    for (uint32_t k = 0; k < 50; ++k) {
        Crash crash = randomCrash(chance, k % 2 != 0);
        crash.hits[0].cracks = 1e4;
        const Paid paid = pay(crash);
        const Vector n = xyz(crash.hits[0].broken.along), arm = crash.hits[0].arm, other = crash.hits[0].other;
        const auto speedAt = [&](uint32_t body, const Vector& r) {
            return n.dot(xyz(paid.states[body].velocity) + xyz(paid.states[body].spin).cross(r));
        };
        EXPECT_NEAR(speedAt(0, arm), crash.bodies[1].moves() ? speedAt(1, other) : 0, 1e-4) << k;
    }
}

TEST(Cracks, OfTwoThatBreakEachOtherArePaidForTogether) {
    Chance chance(7);
    Crash crash = randomCrash(chance, true);
    Hit back = crash.hits[0];
    back.broken.ids = {1, 0, 0, 1};
    back.broken.place = inOwnAxes(crash.bodies[1], back.other);
    back.broken.along = wordsOf(Vector(-xyz(crash.hits[0].broken.along)));
    crash.hits[0].cracks = 0.02;
    back.cracks = 0.03;
    crash.hits.push_back(back);
    const Paid paid = pay(crash);
    const double cost = 0.05 * fractureEnergy();
    const double lost = motionOf(crash, statesOf(crash.bodies)).energy - motionOf(crash, paid.states).energy;
    EXPECT_NEAR(paid.ledger[0].energies.z, cost, 1e-5 * cost);
    EXPECT_EQ(paid.ledger[1].energies.z, 0) << "counted once";
    EXPECT_NEAR(lost, cost, 1e-3 * cost);
}

TEST(Cracks, OfWhatStaysWholeCostNothingAndItIsLeftAloneForAWhile) {
    Chance chance(8);
    for (const uint32_t why : std::initializer_list<uint32_t>{WHOLE_NO_ROOM, WHOLE_TOO_DEAR, WHOLE_ONE_PIECE}) {
        Crash crash = randomCrash(chance, true);
        crash.hits[0].cracks = why == WHOLE_TOO_DEAR ? -0.05 : why == WHOLE_ONE_PIECE ? 0 : 0.05;
        crash.hits[0].refused = why == WHOLE_NO_ROOM;
        const Paid paid = pay(crash);
        EXPECT_EQ(paid.ledger[0].outcome.x, why);
        for (size_t b = 0; b < 2; ++b)
            EXPECT_EQ(std::memcmp(&paid.states[b], &crash.bodies[b].state, sizeof(gpu::BodyState)), 0);
        EXPECT_FLOAT_EQ(paid.breakable[0].form.w, 1 + kPause);
        EXPECT_EQ(paid.breakable[1].form.w, 0);
    }
}

} // namespace
} // namespace kernel_test
