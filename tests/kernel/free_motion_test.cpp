// begin_step, push_bodies, move_bodies and end_step of bodies that touch nothing, against free motion in double precision.
#include "shaders-spirv/shared/narrow_phase.h"
#include "tests/kernel/solver_lab.h"
#include "tests/reference/rigid_motion.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace kernel_test {
namespace {

struct Course {
    double step = 1.0 / 60; // s
    uint32_t substeps = 4, steps = 1;
    Vector gravity = {0, 0, 0};
    uint32_t failed = 0;     // what the status says from the start
    Vector kick = {0, 0, 0}; // of the spin, once in the middle of each step, as contacts would
};

struct Moved {
    std::vector<gpu::BodyState> states;
    uint32_t steps = 0; // as the device counts them
};

struct Buffers {
    explicit Buffers(const std::vector<RigidBody>& bodies)
        : states(bufferOf(statesOf(bodies))), shapes(bufferOf(shapesOf(bodies))),
          solver_bodies(blankBuffer<gpu::SolverBody>(bodies.size())), spins(blankBuffer<gpu::vec4>(bodies.size())),
          none(bufferOf(std::vector<uint32_t>(bodies.size() + 1))), contacts(blankBuffer<gpu::SolverContact>(1)),
          steps(bufferOf(std::vector<uint32_t>(IDLE_STEPS))), shares(blankBuffer<uint32_t>(2 * bodies.size())),
          parents(blankBuffer<uint32_t>(bodies.size())), first_hits(blankBuffer<gpu::FirstHits>(bodies.size())) {
        counts[COUNT_BODIES] = static_cast<uint32_t>(bodies.size());
    }
    Counts counts;
    engine::Buffer states, shapes, solver_bodies, spins, none, contacts, steps, shares, parents, first_hits;
};

void begin(Buffers& b, const gpu::vec4& falling, double lag = 0) {
    const float push[] = {falling.x, falling.y, falling.z, falling.w, static_cast<float>(lag)};
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(
            kernel("begin_step"), b.counts[COUNT_BODIES], push,
            {b.counts.words, b.states, b.shapes, b.solver_bodies, b.spins, b.shares, b.steps, b.parents, b.first_hits});
    });
}

void substep(Buffers& b, const gpu::SolverPush& push) {
    onDevice([&](engine::Commands& commands) {
        const uint32_t bodies = b.counts[COUNT_BODIES];
        commands.dispatch(kernel("push_bodies"), bodies, push,
                          {b.counts.words, b.contacts, b.none, b.none, b.solver_bodies, b.steps, b.none, b.none});
        commands.dispatch(kernel("move_bodies"), bodies, push,
                          {b.counts.words, b.states, b.shapes, b.solver_bodies, b.spins, b.none, b.none, b.none});
    });
}

void end(Buffers& b, const gpu::vec4& falling) {
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(kernel("end_step"), b.counts[COUNT_BODIES], falling,
                          {b.counts.words, b.states, b.shapes, b.solver_bodies, b.spins, b.steps, b.shares});
    });
}

void kick(Buffers& b, const Vector& spin) {
    for (uint32_t k = 0; k < b.counts[COUNT_BODIES]; ++k) {
        gpu::vec4& s = b.solver_bodies.mappedAs<gpu::SolverBody>()[k].spin;
        s = wordsOf(xyz(s) + spin, s.w);
    }
}

Moved moveOnDevice(const std::vector<RigidBody>& bodies, const Course& run) {
    Buffers b(bodies);
    gpu::SolverPush push{};
    push.gravity = wordsOf(run.gravity, run.step / run.substeps);
    b.counts[STATUS_FAILED] = run.failed;
    for (uint32_t step = 0; step < run.steps; ++step) {
        begin(b, wordsOf(run.gravity, run.step), run.step / run.substeps / 2);
        for (uint32_t k = 0; k < run.substeps; ++k) {
            if (k == run.substeps / 2 && !run.kick.isZero()) kick(b, run.kick);
            substep(b, push);
        }
        end(b, wordsOf(run.gravity, run.step));
    }
    return {valuesOf<gpu::BodyState>(b.states, bodies.size()), *b.steps.mappedAs<uint32_t>()};
}

gpu::BodyState movedOne(const RigidBody& body, const Course& run) { return moveOnDevice({body}, run).states[0]; }

Vector placeOf(const gpu::BodyState& state) { return RigidBody{state, {}}.place(); }

std::vector<uint32_t> wordsIn(const gpu::BodyState& state) {
    std::vector<uint32_t> words(sizeof(state) / 4);
    std::memcpy(words.data(), &state, sizeof(state));
    return words;
}

reference::UnitQuaternion quaternionOf(const gpu::vec4& q) {
    const Quaternion unit = turnOf(q);
    return {unit.x(), unit.y(), unit.z(), unit.w()};
}

reference::FreeTurning turningOf(const RigidBody& body) {
    const Vector momentum = xyz(body.state.momentum);
    return {
        {1.0 / body.shape.inverse_inertia[0].x, 1.0 / body.shape.inverse_inertia[1].y, 1.0 / body.shape.inverse_inertia[2].z},
        quaternionOf(body.state.turn),
        {momentum.x(), momentum.y(), momentum.z()}};
}

// Radians that the turn is off after so many steps.
double turnError(const RigidBody& body, const Course& run) {
    const gpu::BodyState state = movedOne(body, run);
    return reference::angleBetween(quaternionOf(state.turn), reference::turnAfter(turningOf(body), run.steps * run.step));
}

// Three moments, and a spin of so many radians a second about no axis in particular.
RigidBody tumbling(uint32_t seed, double spin) {
    Chance chance(seed);
    RigidBody body = randomBody(chance, true);
    body.state.spin = wordsOf(spin * chance.direction());
    body.state.momentum = wordsOf(body.inverseInertia().inverse() * xyz(body.state.spin));
    return body;
}

TEST(SmallFreeMotion, BeginsWithTheInertiaThatABodyHasInTheWorld) {
    Chance chance(20);
    std::vector<RigidBody> bodies;
    for (uint32_t k = 0; k < 65; ++k)
        bodies.push_back(randomBody(chance, k % 8 != 0));
    Buffers b(bodies);
    begin(b, {});
    for (uint32_t k = 0; k < 65; ++k) {
        const gpu::SolverBody s = b.solver_bodies.mappedAs<gpu::SolverBody>()[k];
        Matrix inertia;
        inertia << double{s.inertia.x}, double{s.inertia.y}, double{s.inertia.z}, double{s.inertia.y}, double{s.inertia.w},
            double{s.moved.w}, double{s.inertia.z}, double{s.moved.w}, double{s.spin.w};
        EXPECT_LE((inertia - bodies[k].inverseInertia()).norm(), 1e-5 * (1 + bodies[k].inverseInertia().norm()));
        EXPECT_EQ(s.velocity.w, bodies[k].state.offset.w);
        EXPECT_EQ(xyz(s.velocity), xyz(bodies[k].state.velocity));
        EXPECT_EQ(xyz(s.spin), xyz(bodies[k].state.spin));
        EXPECT_EQ(xyz(s.moved), Vector(0, 0, 0));
    }
}

constexpr double kRounding = 120 * 4.8e-7; // of 120 sums that are less than 16

// Half a second each. Speeds are those of half a substep before.
TEST(SmallFreeMotion, FallsAsGalileiHasItHoweverLongASubstepIs) {
    for (const uint32_t count : {1u, 64u, 65u}) {
        Chance chance(count);
        std::vector<RigidBody> bodies;
        for (uint32_t k = 0; k < count; ++k)
            bodies.push_back(randomBody(chance, true));
        const Course run = {.substeps = count % 3 + 1, .steps = 30, .gravity = {1, -9.81, 2}};
        const Moved moved = moveOnDevice(bodies, run);
        const double time = 30 * run.step, lag = run.step / run.substeps / 2;
        for (uint32_t k = 0; k < count; ++k) {
            const Vector velocity = xyz(bodies[k].state.velocity);
            const Vector way = time * velocity + time * time / 2 * run.gravity;
            EXPECT_LE((placeOf(moved.states[k]) - bodies[k].place() - way).norm(), kRounding);
            EXPECT_LE((xyz(moved.states[k].velocity) - velocity - (time - lag) * run.gravity).norm(), kRounding);
        }
        EXPECT_EQ(moved.steps, 30u);
    }
}

TEST(SmallFreeMotion, KeepsAngularMomentumBitForBit) {
    for (uint32_t seed = 0; seed < 10; ++seed) {
        const RigidBody body = tumbling(seed, 20);
        const gpu::BodyState state = movedOne(body, {.steps = 40});
        EXPECT_EQ(xyz(state.momentum), xyz(body.state.momentum));
        EXPECT_NEAR(turnOf(state.turn).coeffs().norm(), 1, 1e-6);
        EXPECT_LE((RigidBody{state, body.shape}.inverseInertia() * xyz(state.momentum) - xyz(state.spin)).norm(), 1e-4);
    }
}

TEST(SmallFreeMotion, KeepsTheEnergyOfItsTurning) {
    for (uint32_t seed = 0; seed < 10; ++seed) {
        const RigidBody body = tumbling(seed, 10);
        const double before = xyz(body.state.momentum).dot(xyz(body.state.spin));
        const gpu::BodyState state = movedOne(body, {.steps = 120});
        EXPECT_NEAR(xyz(state.momentum).dot(xyz(state.spin)) / before, 1, 2e-3);
    }
}

// With two equal moments the splitting is exact, so only rounding is left. The body keeps its size: a body without thickness
// stops as soon as rounding takes it off its way.
TEST(SmallFreeMotion, OfATopWithTwoEqualMomentsIsExact) {
    for (uint32_t seed = 0; seed < 5; ++seed) {
        RigidBody body = tumbling(seed, 8);
        const float twice = 0.7f, once = 0.4f;
        body.shape.inverse_inertia[0].x = seed % 3 == 1 ? once : twice;
        body.shape.inverse_inertia[1].y = seed % 3 == 2 ? once : twice;
        body.shape.inverse_inertia[2].z = seed % 3 == 0 ? once : twice;
        body.state.momentum = wordsOf(body.inverseInertia().inverse() * xyz(body.state.spin));
        const Course run = {.steps = 60};
        const gpu::vec4 turn = movedOne(body, run).turn;
        const reference::UnitQuaternion expected = reference::turnAfter(turningOf(body), run.steps * run.step);
        EXPECT_LT(reference::angleBetween(quaternionOf(turn), expected), 1e-4)
            << "body " << seed << ": turn " << turn.x << " " << turn.y << " " << turn.z << " " << turn.w << ", expected "
            << expected[0] << " " << expected[1] << " " << expected[2] << " " << expected[3];
    }
}

// Half the substep, a quarter of the error.
TEST(SmallFreeMotion, OfOtherBodiesErrsByTheSquareOfTheSubstep) {
    for (uint32_t seed = 0; seed < 5; ++seed) {
        RigidBody body = tumbling(seed, 12);
        body.shape.inverse_inertia[0].x = 1;
        body.shape.inverse_inertia[1].y = 1 / 2.0f;
        body.shape.inverse_inertia[2].z = 1 / 2.7f;
        body.state.momentum = wordsOf(body.inverseInertia().inverse() * xyz(body.state.spin));
        const double coarse = turnError(body, {.substeps = 1, .steps = 40}),
                     fine = turnError(body, {.substeps = 2, .steps = 40});
        ASSERT_GT(coarse, 2e-4) << "too little to tell from rounding";
        EXPECT_LT(coarse, 0.1);
        EXPECT_GT(coarse / fine, 3);
        EXPECT_LT(coarse / fine, 5);
    }
}

TEST(SmallFreeMotion, TakesUpWhatContactsDidToTheSpin) {
    RigidBody body = tumbling(3, 4);
    const Vector kick(0.3, -0.2, 0.5);
    const gpu::BodyState state = movedOne(body, {.substeps = 4, .kick = kick});
    const reference::UnitQuaternion q = reference::turnAfter(turningOf(body), 2.0 / 240);
    RigidBody then = body;
    then.state.turn = wordsOf(Quaternion(q[3], q[0], q[1], q[2]));
    const Vector expected = xyz(body.state.momentum) + then.inverseInertia().inverse() * kick;
    EXPECT_LE((xyz(state.momentum) - expected).norm(), 1e-3 * expected.norm());
}

// The place is exact wherever it is, and its offset stays within half a sector.
TEST(SmallFreeMotion, CarriesWholeSectorsOver) {
    Chance chance(21);
    for (const double speed : {3.0, 900.0, 9000.0}) {
        RigidBody body = randomBody(chance, true);
        body.state.sector = {-2, 3, 60'000, 0};
        body.state.offset = wordsOf(Vector(7.99, -7.99, 7.9), 1);
        body.state.velocity = wordsOf(speed * Vector(1, -1, 0.5));
        const gpu::BodyState state = movedOne(body, {.steps = 10});
        EXPECT_LE((placeOf(state) - body.place() - speed / 6 * Vector(1, -1, 0.5)).norm(), 1e-6 * speed + 1e-5);
        EXPECT_LE(xyz(state.offset).maxCoeff(), 8);
        EXPECT_GE(xyz(state.offset).minCoeff(), -8);
        EXPECT_NE(state.sector.x, body.state.sector.x);
    }
}

TEST(SmallFreeMotion, IsTheSameFarFromTheOriginBitForBit) {
    RigidBody body = tumbling(4, 6);
    const Course run = {.steps = 30, .gravity = {0, -9.81, 0}};
    const gpu::BodyState near = movedOne(body, run);
    body.state.sector = {60'000, -60'000, 4, 0};
    gpu::BodyState far = movedOne(body, run);
    far.sector.x -= 60'000;
    far.sector.y += 60'000;
    far.sector.z -= 4;
    EXPECT_EQ(wordsIn(far), wordsIn(near));
}

TEST(SmallFreeMotion, LeavesWhatDoesNotMoveWhereItIs) {
    Chance chance(22);
    RigidBody body = randomBody(chance, false);
    body.state.velocity = wordsOf(chance.inBox(3));
    const gpu::BodyState state = movedOne(body, {.steps = 3, .gravity = {0, -9.81, 0}});
    EXPECT_EQ(wordsIn(state), wordsIn(body.state));
}

// What sleeps is for the solver as if it could not move.
TEST(SmallFreeMotion, LeavesWhatIsNotSolvedWhereItIs) {
    const std::vector<RigidBody> bodies = {tumbling(6, 3), tumbling(7, 3)};
    Buffers b(bodies);
    gpu::SolverPush push{};
    push.gravity = wordsOf(Vector(0, -9.81, 0), 1.0 / 240);
    begin(b, {});
    b.solver_bodies.mappedAs<gpu::SolverBody>()[0] = {{}, {}, {}, {}, {0, 0, 0, 1}};
    substep(b, push);
    end(b, {});
    const auto states = valuesOf<gpu::BodyState>(b.states, 2);
    EXPECT_EQ(wordsIn(states[0]), wordsIn(bodies[0].state));
    EXPECT_NE(placeOf(states[1]), bodies[1].place());
}

// Returns the body after `steps` steps. It may go only `share` of its way in each.
gpu::BodyState heldFor(uint32_t steps, const RigidBody& body, const Vector& gravity, float share, float by_still) {
    Buffers b({body});
    gpu::SolverPush push{};
    push.gravity = wordsOf(gravity, 1.0 / 240);
    for (uint32_t step = 0; step < steps; ++step) {
        begin(b, wordsOf(gravity, 1.0 / 60));
        for (uint32_t k = 0; k < 4; ++k)
            substep(b, push);
        b.shares.mappedAs<float>()[0] = share;
        b.shares.mappedAs<float>()[1] = by_still;
        end(b, wordsOf(gravity, 1.0 / 60));
    }
    return valuesOf<gpu::BodyState>(b.states, 1)[0];
}

TEST(SmallFreeMotion, GivesNoGravityForTimeThatIsLost) {
    const RigidBody body = tumbling(6, 3);
    const Vector gravity(0, -9.81, 0);
    const gpu::BodyState held = heldFor(2, body, gravity, 0.25f, 1), free = heldFor(2, body, gravity, 1, 1);
    EXPECT_NEAR((xyz(held.velocity) - xyz(body.state.velocity) - 2 * 0.25 / 60 * gravity).norm(), 0, 1e-5);
    EXPECT_NEAR((xyz(free.velocity) - xyz(body.state.velocity) - 2.0 / 60 * gravity).norm(), 0, 1e-5);
}

TEST(SmallFreeMotion, SlowsWhatHangsInWhatDoesNotMove) {
    const RigidBody body = tumbling(6, 3);
    const gpu::BodyState by_still = heldFor(2, body, {0, 0, 0}, 0.25f, 0.25f),
                         by_moving = heldFor(2, body, {0, 0, 0}, 0.25f, 1);
    EXPECT_NEAR((xyz(by_still.velocity) - 0.25 * xyz(body.state.velocity)).norm(), 0, 1e-6) << "from the second step on";
    EXPECT_NEAR(xyz(by_still.momentum).norm(), 0.25 * xyz(body.state.momentum).norm(), 1e-5 * xyz(body.state.momentum).norm());
    EXPECT_NEAR(xyz(by_still.spin).norm(), 0.25 * xyz(by_moving.spin).norm(), 1e-5);
    EXPECT_NEAR((xyz(by_moving.velocity) - xyz(body.state.velocity)).norm(), 0, 1e-6);
    EXPECT_EQ(by_still.sector.w & BODY_HANGS, BODY_HANGS);
    EXPECT_EQ(by_moving.sector.w & BODY_HANGS, 0);
}

// It may tumble along a floor.
TEST(SmallFreeMotion, SlowsWhatGoesFartherThanItsRadiusOnlyAfterSevenSteps) {
    RigidBody body = tumbling(6, 3);
    body.state.velocity = wordsOf(Vector(200, 0, 0));
    EXPECT_NEAR(heldFor(7, body, {0, 0, 0}, 0.25f, 0.25f).velocity.x, 200, 1e-4);
    EXPECT_NEAR(heldFor(8, body, {0, 0, 0}, 0.25f, 0.25f).velocity.x, 50, 1e-4);
}

// What is no number would spread.
TEST(SmallFreeMotion, StopsWhatFloatsCannotHold) {
    const float no_number = std::numeric_limits<float>::quiet_NaN(), endless = std::numeric_limits<float>::infinity();
    for (const float wrong : {no_number, endless, -endless})
        for (const bool turns : {false, true}) {
            const std::vector<RigidBody> bodies = {tumbling(6, 3), tumbling(7, 3), tumbling(8, 3)};
            Buffers b(bodies);
            begin(b, {});
            gpu::SolverBody& thrown = b.solver_bodies.mappedAs<gpu::SolverBody>()[1];
            (turns ? thrown.spin : thrown.velocity).y = wrong;
            end(b, {});
            EXPECT_EQ(b.counts[STATUS_STOPPED_BODY], 2u);
            const auto states = valuesOf<gpu::BodyState>(b.states, 3);
            EXPECT_EQ(placeOf(states[1]), bodies[1].place());
            for (const gpu::vec4& still : {states[1].velocity, states[1].spin, states[1].momentum})
                EXPECT_EQ(xyz(still), Vector(0, 0, 0));
            EXPECT_EQ(xyz(states[0].velocity), xyz(bodies[0].state.velocity));
            EXPECT_EQ(xyz(states[2].velocity), xyz(bodies[2].state.velocity));
        }
}

TEST(SmallFreeMotion, LeavesAllWhereItWasIfTheStepFailed) {
    const RigidBody body = tumbling(5, 6);
    const Moved moved = moveOnDevice({body, body}, {.steps = 1, .gravity = {0, -9.81, 0}, .failed = FAILED_CAPACITY});
    EXPECT_EQ(moved.steps, 0u);
    for (const gpu::BodyState& state : moved.states) {
        EXPECT_EQ(placeOf(state), body.place());
        EXPECT_EQ(turnOf(state.turn).coeffs(), turnOf(body.state.turn).coeffs());
        EXPECT_EQ(xyz(state.velocity), xyz(body.state.velocity));
    }
}

} // namespace
} // namespace kernel_test
