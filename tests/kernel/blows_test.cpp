// Which contacts break what they touch: find_blows, drop_blows, rank_blows, choose_blows, hold_blows and admit_breaking, on
// balls that meet head on.
#include "modules/brittle/effects/blow.h"
#include "shaders-spirv/shared/breaking.h"
#include "shaders-spirv/shared/pool.h"
#include "tests/kernel/solver_lab.h"

#include <bit>
#include <cmath>

namespace kernel_test {
namespace {

constexpr double kRadius = 0.25;
constexpr uint32_t kCorners = 300;

// Bodies on a line, and pairs of neighbors on it that are about to meet.
struct Line {
    std::vector<RigidBody> bodies;
    std::vector<gpu::BreakableBody> breakable;
    std::vector<gpu::ContactMemory> memory;
    std::vector<std::array<uint32_t, 2>> pieces; // of each contact
    double duration = 1.0 / 60, gravity = 0;
    std::array<uint32_t, 4> room = {256, 100'000, 1 << 20, 512}; // bodies, triangles, sites of a step; fragments of a body
    uint32_t most_pairs = NO_INDEX, most_contacts = NO_INDEX;
    uint32_t room_for_fragments = 1 << 20, kept_for_each = 0, kept_for_whole = 0;

    uint32_t add(double speed, double mass, bool breaks) {
        RigidBody body;
        body.shape.pieces = {static_cast<uint32_t>(bodies.size()), 1, 0, 0};
        const double inertia = 0.4 * mass * kRadius * kRadius;
        body.state.offset = wordsOf(Vector(0, 0, 0), mass > 0 ? 1 / mass : 0);
        body.state.turn = wordsOf(Quaternion::Identity());
        body.state.velocity = wordsOf(Vector(speed, 0, 0));
        for (gpu::vec4& row : body.shape.inverse_inertia)
            row.w = static_cast<float>(kRadius);
        for (int k = 0; k < 3 && mass > 0; ++k)
            (&body.shape.inverse_inertia[k].x)[k] = static_cast<float>(1 / inertia);
        bodies.push_back(body);
        gpu::BreakableBody b{};
        b.surface = {0, breaks ? kCorners : 0, 0, breaks ? 0 : NO_INDEX};
        const auto radius = static_cast<float>(kRadius);
        b.form = {radius * radius * radius * 4.18879f, radius * radius * 12.56637f, 1e6f, 0};
        b.low = {-radius, -radius, -radius, 0};
        b.high = {radius, radius, radius, 0};
        b.turn = wordsOf(Quaternion::Identity());
        breakable.push_back(b);
        return static_cast<uint32_t>(bodies.size() - 1);
    }
    // B is on the right of A, a gap away; or one of its pieces is, and faces A at an angle.
    uint32_t touch(uint32_t a, uint32_t b, double gap, uint32_t piece_b = 0, double angle = 0) {
        gpu::ContactMemory m{};
        m.ids = {a, b, 1, 0};
        m.normal = wordsOf(Vector(std::cos(angle), std::sin(angle), 0));
        m.turn_a = m.turn_b = wordsOf(Quaternion::Identity());
        m.anchor_a[0] = m.arm_a[0] = wordsOf(Vector(kRadius, 0, 0));
        m.anchor_b[0] = m.arm_b[0] = wordsOf(Vector(-kRadius, 0, 0));
        m.arm_a[0].w = static_cast<float>(gap);
        memory.push_back(m);
        pieces.push_back({bodies[a].shape.pieces.x, bodies[b].shape.pieces.x + piece_b});
        return static_cast<uint32_t>(memory.size() - 1);
    }
};

struct Outcome {
    std::vector<gpu::BlowRecord> blows;
    std::vector<uint32_t> touches, shares;
    std::vector<gpu::BrokenBody> broken;
    std::vector<gpu::BreakingRecord> breaking;
    std::vector<gpu::BreakableBody> breakable;
    uint32_t sites = 0, unfit = 0;
};

Outcome judge(const Line& line) {
    const auto pairs = static_cast<uint32_t>(line.memory.size()), count = static_cast<uint32_t>(line.bodies.size());
    Counts counts, event;
    counts[COUNT_BOX_PAIRS] = counts[COUNT_STRUCK] = pairs;
    counts[COUNT_BODIES] = count;
    const engine::Buffer memory = bufferOf(line.memory), pieces = bufferOf(line.pieces),
                         states = bufferOf(statesOf(line.bodies)), shapes = bufferOf(shapesOf(line.bodies)),
                         solver_bodies = bufferOf(solverBodiesOf(line.bodies)),
                         touches = bufferOf(std::vector<uint32_t>(pairs, 1)), breakable = bufferOf(line.breakable),
                         cards = bufferOf(std::vector{brittle::cardOf(*brittle::findMaterial("glass"))}),
                         steps = bufferOf(std::vector<uint32_t>{60, 0, 0, 0}), blows = blankBuffer<gpu::BlowRecord>(pairs),
                         turning = blankBuffer<gpu::TurningBlow>(pairs),
                         soonest = bufferOf(std::vector<uint32_t>(count, NO_INDEX)),
                         hardest = bufferOf(std::vector<uint32_t>(count, 0)),
                         chosen = bufferOf(std::vector<uint32_t>(count, NO_INDEX)),
                         shares = bufferOf(std::vector<uint32_t>(2 * count, std::bit_cast<uint32_t>(1.0f))),
                         breaking = blankBuffer<gpu::BreakingRecord>(MOST_BREAKING),
                         broken = blankBuffer<gpu::BrokenBody>(MOST_BREAKING);
    const float find[] = {static_cast<float>(line.gravity), 0, 0, static_cast<float>(line.duration / 4),
                          static_cast<float>(line.duration)};
    const struct {
        uint32_t room[4], seed, most_pairs, most_contacts;
        float duration, margin, pause;
        uint32_t kept_for_each, kept_for_whole;
    } admit = {{line.room[0], line.room[1], line.room[2], line.room[3]},
               7,
               line.most_pairs,
               line.most_contacts,
               static_cast<float>(line.duration),
               0.02f,
               0.25f,
               line.kept_for_each,
               line.kept_for_whole};
    std::vector<gpu::PoolHeader> headers(POOLS);
    headers[POOL_BODIES].capacity = line.room_for_fragments;
    const engine::Buffer pools = bufferOf(headers);
    const engine::Buffer reach_sums = blankBuffer<uint32_t>(MOST_BREAKING); // of what breaks in rays, which nothing does
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(
            kernel("find_blows"), pairs, find,
            {counts.words, memory, states, solver_bodies, touches, breakable, cards, steps, blows, turning, shapes});
        const auto duration = static_cast<float>(line.duration);
        commands.dispatch(kernel("drop_blows"), pairs, duration,
                          {counts.words, pieces, memory, states, shapes, breakable, blows, soonest});
        commands.dispatch(kernel("rank_blows"), pairs, duration,
                          {counts.words, memory, states, breakable, soonest, blows, hardest});
        commands.dispatch(kernel("choose_blows"), pairs, engine::NoPush{}, {counts.words, memory, blows, hardest, chosen});
        commands.dispatch(kernel("hold_blows"), pairs, engine::NoPush{},
                          {counts.words, memory, states, blows, chosen, touches, shares});
        commands.dispatchGroups(kernel("admit_breaking"), 1, admit,
                                {counts.words, memory, states, shapes, blows, chosen, cards, steps, breakable, breaking, broken,
                                 event.words, event.args, reach_sums, pools});
    });
    return {valuesOf<gpu::BlowRecord>(blows, pairs),
            valuesOf<uint32_t>(touches, pairs),
            valuesOf<uint32_t>(shares, 2 * count),
            valuesOf<gpu::BrokenBody>(broken, event[COUNT_BREAKING] + (event[STATUS_UNFIT] != 0 ? 1 : 0)),
            valuesOf<gpu::BreakingRecord>(breaking, event[COUNT_BREAKING]),
            valuesOf<gpu::BreakableBody>(breakable, count),
            event[COUNT_ASKED_SITES],
            event[STATUS_UNFIT]};
}

TEST(Blows, HaveTheEnergyThatTwoBodiesHaveAlongTheNormalWhenTheyMeet) {
    Line line;
    const uint32_t a = line.add(7, 3, true), b = line.add(-2, 5, false);
    line.touch(a, b, 0.05);
    const Outcome out = judge(line);
    const double mass = 15.0 / 8;
    ASSERT_EQ(out.blows[0].sides.x, uint32_t{BREAKS_A});
    EXPECT_NEAR(out.blows[0].blow.x, mass, 1e-6);
    EXPECT_NEAR(out.blows[0].blow.y, 9, 1e-5);
    EXPECT_NEAR(out.blows[0].blow.z, 0.5 * mass * 81, 1e-4);
    EXPECT_NEAR(out.blows[0].blow.w, 0.05 / (9 * line.duration), 1e-5) << "the share of the step until they meet";
}

// The solver brakes what would meet in the substep after the step's last. That is left alone, and is a blow of the next step;
// what breaks nothing is the solver's.
TEST(Blows, AreThoseOfBodiesThatMeetInTheStep) {
    constexpr double kStep = 9 * (1.0 / 60), kBraked = 9 * (1.0 / 60 + 1.05 / 240);
    for (const bool breaks : {true, false})
        for (const double gap : {0.0, 0.1, 0.149, 0.151, 0.186, 0.192, 0.3}) {
            Line line;
            const uint32_t a = line.add(9, 3, breaks), wall = line.add(0, 0, false);
            line.touch(a, wall, gap);
            const Outcome out = judge(line);
            EXPECT_EQ(out.blows[0].sides.x != 0, breaks && gap < kStep) << gap;
            EXPECT_EQ(out.touches[0], breaks && gap < kBraked ? 0u : 1u) << gap;
        }
}

// What lies behind a piece would be met if that were not there.
TEST(Blows, OfABodyOfManyPiecesAreAtThePieceThatIsMetFirst) {
    for (const double first_angle : {0.0, 0.5, 1.4}) {
        Line line;
        const uint32_t a = line.add(9, 3, true), wall = line.add(0, 0, false);
        line.bodies[wall].shape.pieces = {1, 3, 0, 0};
        line.touch(a, wall, 0.01 * std::cos(first_angle), 0, first_angle);
        line.touch(a, wall, 0.08, 1);
        line.touch(a, wall, 0.01001, 2);
        const Outcome out = judge(line);
        EXPECT_EQ(out.blows[1].sides.x, 0u) << "long after the first";
        EXPECT_EQ(out.blows[2].sides.x, uint32_t{BREAKS_A}) << "together with the first";
    }
}

TEST(Blows, ComeFromThatWhichMeetsABodyFirst) {
    Line line;
    const uint32_t a = line.add(20, 3, false), vase = line.add(0, 3, true), b = line.add(-9, 3, false);
    line.touch(a, vase, 0.1);
    line.touch(vase, b, 0.04);
    const Outcome out = judge(line);
    EXPECT_NE(out.blows[0].sides.x, 0u);
    EXPECT_EQ(out.blows[0].sides.z, 0u) << "harder, and later";
    EXPECT_EQ(out.blows[1].sides.z, 1u);
    ASSERT_EQ(out.broken.size(), 1u);
    EXPECT_EQ(out.broken[0].ids.y, b);
}

// A foot that it stands on, for one.
TEST(Blows, OfABodyOfManyPiecesAreNotStoppedByWhatTouchesAndHardlyComesCloser) {
    Line line;
    const uint32_t a = line.add(9, 3, true), wall = line.add(0, 0, false);
    line.bodies[wall].shape.pieces = {1, 2, 0, 0};
    line.touch(a, wall, 0, 0, 1.5);
    line.touch(a, wall, 0.08, 1);
    EXPECT_EQ(judge(line).blows[1].sides.x, uint32_t{BREAKS_A});
}

TEST(Blows, OfAFallingBodyDoNotDependOnTheStep) {
    for (const double duration : {1.0 / 30, 1.0 / 60, 1.0 / 120}) {
        Line line;
        line.duration = duration;
        line.gravity = 9.81;
        // Half a centimeter above the floor of a fall of two meters; speeds lag by half a substep.
        const double before = std::sqrt(2 * 9.81 * 1.995);
        const uint32_t a = line.add(before - 0.5 * 9.81 * duration / 4, 3, true), floor = line.add(0, 0, false);
        line.touch(a, floor, 0.005);
        EXPECT_NEAR(judge(line).blows[0].blow.z, 3 * 9.81 * 2, 1e-3) << duration;
    }
}

TEST(Blows, AreNoneWhereBodiesPartOrRestOrAreTooSlowOrMayNotBreakYet) {
    Line line;
    const uint32_t parting = line.add(-9, 3, true), resting = line.add(0, 3, true), slow = line.add(0.01, 3, true),
                   fresh = line.add(9, 3, true), wall = line.add(0, 0, false);
    line.breakable[fresh].form.w = 1.5f; // the world's time is 1
    for (const uint32_t body : {parting, resting, slow, fresh})
        line.touch(body, wall, 0);
    const Outcome out = judge(line);
    for (size_t p = 0; p < 4; ++p) {
        EXPECT_EQ(out.blows[p].sides.x, 0u) << p;
        EXPECT_EQ(out.touches[p], 1u) << p;
    }
    EXPECT_TRUE(out.broken.empty());
}

TEST(Blows, OfABodyAreOneAStepTheHardest) {
    Line line;
    const uint32_t left = line.add(20, 3, true), middle = line.add(0, 3, true), right = line.add(-30, 3, true);
    line.touch(left, middle, 0.01);
    line.touch(middle, right, 0.01);
    const Outcome out = judge(line);
    EXPECT_EQ(out.touches, (std::vector<uint32_t>{0, 0})) << "the other waits for the next step, unsolved";
    ASSERT_EQ(out.broken.size(), 2u);
    EXPECT_EQ(out.broken[0].ids.x, middle);
    EXPECT_EQ(out.broken[1].ids.x, right);
    EXPECT_EQ(out.broken[0].ids.z, 1u);
    EXPECT_FLOAT_EQ(out.broken[0].blow.z, out.broken[1].blow.z) << "two that break share the energy";
    const auto share = [&](uint32_t body) { return static_cast<double>(std::bit_cast<float>(out.shares[2 * body])); };
    EXPECT_NEAR(share(left), 0.01 / (20 * line.duration), 1e-5);
    EXPECT_NEAR(share(right), 0.01 / (30 * line.duration), 1e-5);
}

TEST(Blows, OnAWallAreAsManyAsHitIt) {
    Line line;
    const uint32_t wall = line.add(0, 0, false);
    for (uint32_t k = 0; k < 70; ++k)
        line.touch(line.add(10 + 0.1 * k, 3, true), wall, 0.001);
    const Outcome out = judge(line);
    ASSERT_EQ(out.broken.size(), 70u);
    uint32_t corners = 0, sites = 0;
    for (uint32_t k = 0; k < 70; ++k) {
        EXPECT_EQ(out.broken[k].ids.x, k + 1) << "in the order of bodies";
        EXPECT_EQ(out.breaking[k].range.w, corners);
        EXPECT_EQ(out.breaking[k].sites.x, sites);
        corners += kCorners;
        sites += out.breaking[k].sites.y;
    }
    EXPECT_EQ(out.sites, sites);
}

// Bodies that a wall is hit by, each by its own pair.
Line manyAtAWall(uint32_t count, double speed = 10) {
    Line line;
    const uint32_t wall = line.add(0, 0, false);
    for (uint32_t k = 0; k < count; ++k)
        line.touch(line.add(speed, 3, true), wall, 0.001);
    return line;
}

TEST(Blows, WaitWhereThereIsNoRoomInThisStepAndAreDroppedWhereThereNeverIs) {
    Line line = manyAtAWall(5);
    line.room = {256, 2 * kCorners / 3, 4096, 512};
    const Outcome two = judge(line);
    ASSERT_EQ(two.broken.size(), 2u);
    EXPECT_EQ(two.unfit, 0u);
    EXPECT_EQ(two.touches, std::vector<uint32_t>(5, 0));
    line.breakable[3].surface.y = 3 * kCorners;
    const Outcome without = judge(line);
    ASSERT_EQ(without.broken.size(), 3u) << "who does not fit is behind them, to be told of";
    EXPECT_EQ(without.broken[1].ids.x, 2u);
    EXPECT_EQ(without.unfit, uint32_t{WHOLE_TOO_LARGE});
    EXPECT_EQ(without.broken[2].ids.x, 3u);
    EXPECT_GT(without.breakable[3].form.w, 1e30f);
}

TEST(Blows, LeaveFragmentsToBodiesThatHaveNotBrokenYet) {
    Line line = manyAtAWall(5, 100);
    line.kept_for_each = 8;
    line.room_for_fragments = 1 << 20;
    const Outcome plenty = judge(line);
    line.room_for_fragments = 60;
    const Outcome few = judge(line);
    ASSERT_EQ(few.broken.size(), 5u);
    EXPECT_EQ(few.unfit, 0u);
    EXPECT_LE(few.sites, 60u);
    for (uint32_t k = 0; k < 5; ++k) {
        EXPECT_GT(plenty.breaking[k].sites.y, 60u);
        EXPECT_GE(few.breaking[k].sites.y, 8u) << k;
    }
    EXPECT_EQ(few.breaking[0].sites.y, (60u - 4 * 8) / 2) << "half of what is not kept";
    EXPECT_EQ(few.broken[0].share.y, plenty.broken[0].share.y) << "what the blow pays for is told all the same";
    line.breakable[1].form.w = 3e38f;
    line.memory.erase(line.memory.begin());
    EXPECT_EQ(judge(line).breaking[0].sites.y, (60u - 3 * 8) / 2) << "nothing is kept for what never breaks";
}

TEST(Blows, OnFragmentsLeaveHalfOfTheBudgetToBodiesThatHaveNotBrokenYet) {
    Line line = manyAtAWall(2, 100);
    line.kept_for_whole = 512;
    line.breakable[1].balance.w = 1; // the step that it was made in
    line.room_for_fragments = 512 + 40;
    EXPECT_EQ(judge(line).breaking[0].sites.y, 10u);
    line.room_for_fragments = 512;
    const Outcome none = judge(line);
    ASSERT_EQ(none.broken.size(), 2u);
    EXPECT_EQ(none.broken[0].ids.x, 2u) << "the whole one breaks";
    EXPECT_EQ(none.unfit, uint32_t{WHOLE_NO_ROOM});
    EXPECT_EQ(none.broken[1].ids.x, 1u);
    EXPECT_GE(none.broken[1].share.z, 2.0f) << "fragments that lack";
    line.breakable[2].balance.w = 1;
    EXPECT_EQ(judge(line).breaking[0].sites.y, 512u / 4) << "there is nobody to leave them to";
}

// The sphere around the impact and the grid are checked in the gathering of what breaks; here, that the place is the contact's.
TEST(Blows, AreWhereTheContactIsOnTheGridOfTheBody) {
    Line line;
    const uint32_t a = line.add(12, 3, true), wall = line.add(0, 0, false);
    line.bodies[a].state.turn = wordsOf(turnBy(0.5 * 3.14159265358979, Vector(0, 0, 1)));
    line.memory.clear();
    line.touch(a, wall, 0.001);
    line.memory[0].turn_a = line.bodies[a].state.turn;
    line.memory[0].anchor_a[0] = wordsOf(Vector(0, -kRadius, 0)); // the own axis that points at the wall
    const Outcome out = judge(line);
    ASSERT_EQ(out.breaking.size(), 1u);
    const gpu::BreakingRecord& r = out.breaking[0];
    EXPECT_EQ(r.center.w, 2.0f);
    EXPECT_NEAR(r.impact.x, 1 << 23, 8);
    EXPECT_EQ(r.impact.y, (1 << 23) - (1 << 22)) << "half of the grid's half is the ball's radius";
    EXPECT_GE(r.impact.w, 1);
    EXPECT_NEAR(r.low.w, std::sqrt(1.5) * (1 << 23), 16) << "to the furthest corner of the box";
}

} // namespace
} // namespace kernel_test
