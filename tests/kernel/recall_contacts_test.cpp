// recall_contacts: which pair of the last step each pair is, and whether its points still serve.
#include "shaders-spirv/shared/broad_phase.h"
#include "tests/kernel/solver_lab.h"

#include <algorithm>
#include <map>
#include <numbers>

namespace kernel_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

gpu::ContactMemory foundAt(const std::vector<RigidBody>& bodies, uint32_t a, uint32_t b, uint32_t points) {
    gpu::ContactMemory memory{};
    memory.ids = {a, b, points, 5};
    memory.turn_a = bodies[a].state.turn;
    memory.turn_b = bodies[b].state.turn;
    memory.place = wordsOf(turnOf(memory.turn_a).inverse() * (bodies[b].place() - bodies[a].place()));
    return memory;
}

struct Memories {
    std::vector<Word2> pairs;                 // sorted
    std::vector<gpu::ContactMemory> contacts; // one a pair
};

struct Recalled {
    std::vector<uint32_t> at, fresh;
};

struct Push {
    float gravity[4] = {0, 0, 0, 0}; // w: for how long pairs are swept
    float speculative = 0.02f;
    uint32_t recycling = 1;
};

Recalled recallOnDevice(const std::vector<Word2>& pairs, const Memories& old, const std::vector<RigidBody>& bodies,
                        const Push& push = {}) {
    Counts counts;
    const auto count = static_cast<uint32_t>(pairs.size());
    counts[COUNT_BOX_PAIRS] = count;
    const engine::Buffer now = bufferOf(pairs), old_count = bufferOf(std::vector<uint32_t>{uint32_t(old.pairs.size())}),
                         old_pairs = bufferOf(old.pairs), old_memory = bufferOf(old.contacts),
                         states = bufferOf(statesOf(bodies)), shapes = bufferOf(shapesOf(bodies)),
                         at = blankBuffer<uint32_t>(count), fresh = blankBuffer<uint32_t>(count);
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(kernel("recall_contacts"), count, push,
                          {counts.words, now, old_count, old_pairs, old_memory, states, shapes, at, fresh});
    });
    return {valuesOf<uint32_t>(at, count), valuesOf<uint32_t>(fresh, count)};
}

// About so many of all pairs of the bodies, in order.
std::vector<Word2> somePairs(Chance& chance, uint32_t bodies, uint32_t one_in) {
    std::vector<Word2> pairs;
    for (uint32_t a = 0; a < bodies; ++a)
        for (uint32_t b = a + 1; b < bodies; ++b)
            if (chance.oneIn(one_in)) pairs.push_back({a, b});
    return pairs;
}

TEST(SmallRecallContacts, FindEveryPairThatWasThereBefore) {
    Chance chance(1);
    for (const uint32_t body_count : {2u, 9u, 60u}) {
        const std::vector<RigidBody> bodies = randomBodies(chance, body_count);
        for (const uint32_t one_in : {1u, 2u, 1000u}) {
            const std::vector<Word2> pairs = somePairs(chance, body_count, 2);
            Memories old = {somePairs(chance, body_count, one_in), {}};
            std::map<Word2, uint32_t> place;
            for (const Word2& pair : old.pairs) {
                place[pair] = static_cast<uint32_t>(old.contacts.size());
                old.contacts.push_back(foundAt(bodies, pair[0], pair[1], 2));
            }
            const Recalled recalled = recallOnDevice(pairs, old, bodies);
            for (size_t k = 0; k < pairs.size(); ++k) {
                const bool is_old = place.contains(pairs[k]);
                EXPECT_EQ(recalled.at[k], is_old ? place[pairs[k]] : NO_INDEX);
                EXPECT_EQ(recalled.fresh[k], is_old ? 0u : 1u);
            }
        }
    }
}

TEST(SmallRecallContacts, KeepNothingThatDidNotTouchNorWhereNothingIsToBeKept) {
    Chance chance(2);
    const std::vector<RigidBody> bodies = randomBodies(chance, 2);
    const std::vector<Word2> pairs = {{0, 1}};
    EXPECT_EQ(recallOnDevice(pairs, {pairs, {foundAt(bodies, 0, 1, 4)}}, bodies).fresh[0], 0u);
    EXPECT_EQ(recallOnDevice(pairs, {pairs, {foundAt(bodies, 0, 1, 0)}}, bodies).fresh[0], 1u);
    const Push anew = {.recycling = 0};
    EXPECT_EQ(recallOnDevice(pairs, {pairs, {foundAt(bodies, 0, 1, 4)}}, bodies, anew).fresh[0], 1u);
    EXPECT_EQ(recallOnDevice(pairs, {pairs, {foundAt(bodies, 0, 1, 4)}}, bodies, anew).at[0], 0u);
}

// Nothing has changed between them, wherever they say they are: else they would not sleep.
TEST(SmallRecallContacts, FindNothingAnewBetweenBodiesThatSleep) {
    Chance chance(12);
    const std::vector<RigidBody> before = randomBodies(chance, 2);
    for (const bool both : {true, false}) {
        std::vector<RigidBody> after = before;
        after[1].state.turn = wordsOf(chance.turn());
        after[0].state.sector.w = BODY_ASLEEP;
        if (both) after[1].state.sector.w = BODY_ASLEEP;
        EXPECT_EQ(recallOnDevice({{0, 1}}, {{{0, 1}}, {foundAt(before, 0, 1, 4)}}, after).fresh[0], both ? 0u : 1u);
    }
}

// A meter from each other, of 2 m each, so that they may move by 50 mm.
std::vector<RigidBody> twoNeighbors() {
    Chance chance(3);
    std::vector<RigidBody> bodies = randomBodies(chance, 2);
    for (RigidBody& body : bodies)
        body.shape.inverse_inertia[2].w = 2;
    bodies[0].state.offset = wordsOf(Vector(7.9, 0, 0), 1);
    bodies[1].state.offset = wordsOf(Vector(7.9, 1, 0), 1);
    return bodies;
}

bool keptAfter(const std::vector<RigidBody>& before, const std::vector<RigidBody>& after) {
    return recallOnDevice({{0, 1}}, {{{0, 1}}, {foundAt(before, 0, 1, 4)}}, after).fresh[0] == 0;
}

void turnOne(RigidBody& body, const Quaternion& turn) { body.state.turn = wordsOf(turn * turnOf(body.state.turn)); }

TEST(SmallRecallContacts, KeepWhatMovesTogetherHoweverFarItGoes) {
    const std::vector<RigidBody> before = twoNeighbors();
    std::vector<RigidBody> after = before;
    for (RigidBody& body : after)
        body.state.sector.y += 6000;
    after[1].state.sector.x += 1; // the same place by another name
    after[1].state.offset.x -= SECTOR_EDGE;
    EXPECT_TRUE(keptAfter(before, after));
}

// The arms are kept along the world's axes.
TEST(SmallRecallContacts, AreFoundAnewOnceEitherHasTurnedByTenDegrees) {
    const std::vector<RigidBody> before = twoNeighbors();
    for (const double degrees : {9.9, -9.9, 10.1, -10.1, 180.0}) {
        std::vector<RigidBody> after = before;
        const Quaternion turn = turnBy(degrees * kDegree, {1, 2, 3});
        turnOne(after[0], turn);
        turnOne(after[1], turn);
        after[1].state.offset = wordsOf(xyz(after[0].state.offset) + turn * Vector(0, 1, 0), 1);
        EXPECT_EQ(keptAfter(before, after), std::fabs(degrees) < 10) << degrees;
    }
}

TEST(SmallRecallContacts, AreFoundAnewOnceOneHasMovedByFiveCentimetersAgainstTheOther) {
    const std::vector<RigidBody> before = twoNeighbors();
    for (const double way : {0.0, 0.0499, 0.0501, 3.0}) {
        std::vector<RigidBody> after = before;
        after[1].state.offset = wordsOf(xyz(before[1].state.offset) + way * Vector(2, -1, 2) / 3, 1);
        EXPECT_EQ(keptAfter(before, after), way < 0.05) << way;
    }
}

// A quaternion and its opposite are one turn.
TEST(SmallRecallContacts, DoNotMindTheSignOfATurn) {
    const std::vector<RigidBody> before = twoNeighbors();
    std::vector<RigidBody> after = before;
    gpu::vec4& q = after[1].state.turn;
    q = {-q.x, -q.y, -q.z, -q.w};
    EXPECT_TRUE(keptAfter(before, after));
}

double radiusOf(const RigidBody& body) { return double{body.shape.inverse_inertia[2].w}; }

// How far a point on the smaller one's rim has gone, seen by the larger: the way of its center, and the chord of its turn.
double movedBy(const std::vector<RigidBody>& before, const std::vector<RigidBody>& after) {
    const auto frame = [](const RigidBody& body) { return turnOf(body.state.turn).toRotationMatrix(); };
    const size_t larger = radiusOf(before[0]) >= radiusOf(before[1]) ? 0 : 1;
    const auto place = [&](const std::vector<RigidBody>& b) -> Vector {
        return frame(b[larger]).transpose() * (b[1 - larger].place() - b[larger].place());
    };
    const Matrix was = frame(before[0]).transpose() * frame(before[1]), is = frame(after[0]).transpose() * frame(after[1]);
    const double chord = (is - was).norm() / std::sqrt(2.0); // 2 sin(angle / 2)
    return (place(after) - place(before)).norm() + chord * radiusOf(before[1 - larger]);
}

TEST(SmallRecallContacts, AreKeptAsLongAsNoPointHasMovedByThreeHundredthsOfTheSmallerBody) {
    Chance chance(4);
    uint32_t kept = 0, anew = 0;
    for (int k = 0; k < 400; ++k) {
        const std::vector<RigidBody> before = randomBodies(chance, 2);
        std::vector<RigidBody> after = before;
        const double smaller = std::min(radiusOf(before[0]), radiusOf(before[1]));
        for (RigidBody& body : after) {
            body.state.offset = wordsOf(xyz(body.state.offset) + chance.inBox(0.012 * smaller), body.state.offset.w);
            turnOne(body, turnBy(chance.between(0, 0.015), chance.direction()));
        }
        const double moved = movedBy(before, after), most = std::min(0.05, 0.03 * smaller);
        if (std::fabs(moved - most) < 1e-5) continue; // rounding decides
        EXPECT_EQ(keptAfter(before, after), moved < most) << moved << " of " << most;
        ++(moved < most ? kept : anew);
    }
    EXPECT_GT(kept, 100u);
    EXPECT_GT(anew, 100u);
}

double rimSpeedOf(const RigidBody& body) { return body.moves() ? xyz(body.state.spin).norm() * radiusOf(body) : 0; }

// What they have moved since and what they may still move and turn is less than the gap, with what points are looked for in.
TEST(SmallRecallContacts, LookAtWhatWasApartOnlyOnceItCanHaveComeNear) {
    Chance chance(6);
    uint32_t left = 0, looked_at = 0;
    for (int k = 0; k < 400; ++k) {
        const std::vector<RigidBody> before = randomBodies(chance, 2);
        std::vector<RigidBody> after = before;
        for (RigidBody& body : after)
            body.state.offset = wordsOf(xyz(body.state.offset) + chance.inBox(0.05), body.state.offset.w);
        const Push push = {{0, -10, 0, 0.02f}, 0.03f, 1};
        gpu::ContactMemory memory = foundAt(before, 0, 1, 0);
        memory.place.w = static_cast<float>(chance.between(0, 1.5));
        const auto falls = [&](const RigidBody& body) {
            return body.state.offset.w != 0 ? Vector(0, -0.2, 0) : Vector(0, 0, 0);
        };
        const Vector speed = xyz(after[1].state.velocity) + falls(after[1]) - xyz(after[0].state.velocity) - falls(after[0]);
        const double rims = rimSpeedOf(after[0]) + rimSpeedOf(after[1]);
        const double needed = movedBy(before, after) + 0.02 * (speed.norm() + rims) + 0.03;
        if (std::fabs(needed - memory.place.w) < 2e-4) continue; // a ten-thousandth is left for rounding
        const bool looks = recallOnDevice({{0, 1}}, {{{0, 1}}, {memory}}, after, push).fresh[0] != 0;
        EXPECT_EQ(looks, needed > memory.place.w) << needed << " of " << memory.place.w;
        ++(looks ? looked_at : left);
    }
    EXPECT_GT(left, 50u);
    EXPECT_GT(looked_at, 50u);
}

} // namespace
} // namespace kernel_test
