// remember_contacts: what is kept of a contact as it was, and what becomes of it where its points are found anew.
#include "shaders-spirv/shared/broad_phase.h"
#include "tests/kernel/solver_lab.h"

#include <algorithm>
#include <bit>

namespace kernel_test {
namespace {

struct Pair {
    gpu::Manifold manifold = {}; // of a fresh one
    gpu::ContactMemory old = {};
    bool fresh = true, was_there = false;
};

struct Remembered {
    std::vector<gpu::ContactMemory> contacts;
    std::vector<uint32_t> touches;
};

Remembered rememberOnDevice(const std::vector<Pair>& pairs, const std::vector<RigidBody>& bodies) {
    const auto count = static_cast<uint32_t>(pairs.size());
    std::vector<uint32_t> recalled, slots = {0};
    std::vector<gpu::Manifold> manifolds;
    std::vector<gpu::ContactMemory> old;
    for (const Pair& pair : pairs) {
        recalled.push_back(pair.was_there ? static_cast<uint32_t>(old.size()) : NO_INDEX);
        if (pair.was_there) old.push_back(pair.old);
        if (pair.fresh) manifolds.push_back(pair.manifold);
        slots.push_back(static_cast<uint32_t>(manifolds.size()));
    }
    Counts counts;
    counts[COUNT_BOX_PAIRS] = count;
    const engine::Buffer at = bufferOf(recalled), fresh_slots = bufferOf(slots), found = bufferOf(manifolds),
                         old_memory = bufferOf(old), states = bufferOf(statesOf(bodies)), shapes = bufferOf(shapesOf(bodies)),
                         memory = blankBuffer<gpu::ContactMemory>(count), touches = blankBuffer<uint32_t>(count);
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(kernel("remember_contacts"), count, engine::NoPush{},
                          {counts.words, at, fresh_slots, found, old_memory, states, shapes, memory, touches});
    });
    return {valuesOf<gpu::ContactMemory>(memory, count), valuesOf<uint32_t>(touches, count)};
}

gpu::Manifold randomManifold(Chance& chance, uint32_t a, uint32_t b, uint32_t points) {
    gpu::Manifold m{};
    m.pair = {a, b, a, b};
    m.normal = wordsOf(chance.direction());
    m.info = {points, 0, 0, 0};
    for (uint32_t k = 0; k < points; ++k) {
        m.points[k].arm_a = wordsOf(chance.inBox(1), chance.between(-0.01, 0.01));
        m.points[k].arm_b = wordsOf(chance.inBox(1));
        m.points[k].id = {100 + k, 0, 0, 0};
    }
    return m;
}

gpu::ContactMemory randomMemory(Chance& chance, uint32_t a, uint32_t b, uint32_t points) {
    gpu::ContactMemory memory{};
    const Vector normal = chance.direction();
    memory.ids = {a, b, points, chance.below(COLORS)};
    memory.normal = wordsOf(normal, 0.4);
    memory.tangent = wordsOf(normal.unitOrthogonal(), 0.2);
    memory.rub = wordsOf(chance.inBox(3), 0);
    memory.turn_a = wordsOf(chance.turn());
    memory.turn_b = wordsOf(chance.turn());
    memory.place = wordsOf(chance.inBox(1));
    for (uint32_t k = 0; k < points; ++k) {
        memory.anchor_a[k] = wordsOf(chance.inBox(1), chance.between(0, 5));
        memory.anchor_b[k] = wordsOf(chance.inBox(1), double{std::bit_cast<float>(100 + k)});
        memory.arm_a[k] = wordsOf(chance.inBox(1));
        memory.arm_b[k] = wordsOf(chance.inBox(1));
    }
    return memory;
}

std::vector<uint32_t> wordsIn(const gpu::ContactMemory& memory) {
    std::vector<uint32_t> words(sizeof(memory) / 4);
    std::memcpy(words.data(), &memory, sizeof(memory));
    return words;
}

void expectNear(const gpu::vec4& got, const Vector& wanted, double tolerance) {
    EXPECT_LE((xyz(got) - wanted).norm(), tolerance) << xyz(got).transpose() << " instead of " << wanted.transpose();
}

// Impulse of friction in the world: along the tangent and across it.
Vector slideOf(const gpu::ContactMemory& m) {
    return double{m.rub.x} * xyz(m.tangent) + double{m.rub.y} * xyz(m.normal).cross(xyz(m.tangent));
}

void expectFrame(const gpu::ContactMemory& memory, const gpu::Manifold& manifold, const RigidBody& a, const RigidBody& b) {
    expectNear(memory.normal, xyz(manifold.normal), 0);
    EXPECT_NEAR(xyz(memory.tangent).norm(), 1, 1e-6);
    EXPECT_NEAR(xyz(memory.tangent).dot(xyz(memory.normal)), 0, 1e-6);
    const double friction_a = a.shape.inverse_inertia[0].w, friction_b = b.shape.inverse_inertia[0].w;
    EXPECT_NEAR(memory.normal.w, std::sqrt(friction_a * friction_b), 1e-6);
    EXPECT_EQ(memory.tangent.w, std::max(a.shape.inverse_inertia[1].w, b.shape.inverse_inertia[1].w));
}

// The smaller one's arms stay.
int armsOf(const RigidBody& a, const RigidBody& b) {
    return a.shape.inverse_inertia[2].w < b.shape.inverse_inertia[2].w ? ARMS_OF_B_FOLLOW : ARMS_OF_A_FOLLOW;
}

// Points stand where they were found, in the bodies' own axes, and so does B seen from A.
void expectPlaces(const gpu::ContactMemory& memory, const gpu::Manifold& manifold, const RigidBody& a, const RigidBody& b) {
    const Quaternion turn_a = turnOf(a.state.turn), turn_b = turnOf(b.state.turn);
    expectNear(memory.place, turn_a.inverse() * (b.place() - a.place()), 1e-5);
    for (uint32_t k = 0; k < manifold.info.x; ++k) {
        expectNear(memory.anchor_a[k], turn_a.inverse() * xyz(manifold.points[k].arm_a), 1e-6);
        expectNear(memory.anchor_b[k], turn_b.inverse() * xyz(manifold.points[k].arm_b), 1e-6);
        expectNear(memory.arm_a[k], xyz(manifold.points[k].arm_a), 0);
        expectNear(memory.arm_b[k], xyz(manifold.points[k].arm_b), 0);
        EXPECT_EQ(std::bit_cast<uint32_t>(memory.anchor_b[k].w), manifold.points[k].id.x);
    }
}

TEST(SmallRememberContacts, WhatIsKeptIsAsItWasAndKnownForIt) {
    Chance chance(6);
    const std::vector<RigidBody> bodies = randomBodies(chance, 2);
    std::vector<Pair> pairs;
    for (uint32_t k = 0; k < 130; ++k) {
        pairs.push_back({randomManifold(chance, 0, 1, 2), randomMemory(chance, 0, 1, 1 + k % 4), k % 3 == 0, true});
        if (pairs.back().fresh && k % 2 == 0) pairs.back().was_there = false;
    }
    const Remembered now = rememberOnDevice(pairs, bodies);
    for (size_t k = 0; k < pairs.size(); ++k) {
        if (pairs[k].fresh) continue;
        EXPECT_EQ(wordsIn(now.contacts[k]), wordsIn(pairs[k].old));
        EXPECT_EQ(now.touches[k], 1u);
    }
}

TEST(SmallRememberContacts, WhatIsNewBeginsWithoutColorAndImpulse) {
    Chance chance(7);
    const std::vector<RigidBody> bodies = {randomBody(chance, true), randomBody(chance, false), randomBody(chance, true)};
    for (uint32_t points = 0; points <= MANIFOLD_POINTS; ++points) {
        const gpu::Manifold manifold = randomManifold(chance, 0, 1 + points % 2, points);
        const Remembered now = rememberOnDevice({{manifold, {}, true, false}}, bodies);
        const gpu::ContactMemory& memory = now.contacts[0];
        EXPECT_EQ(now.touches[0], points > 0 ? 1u : 0u);
        EXPECT_EQ(memory.ids.x, 0u);
        EXPECT_EQ(memory.ids.y, 1 + points % 2);
        EXPECT_EQ(memory.ids.z, points);
        EXPECT_EQ(memory.ids.w, NO_INDEX);
        EXPECT_EQ(memory.rub.w, armsOf(bodies[0], bodies[1 + points % 2]));
        expectNear(memory.rub, Vector::Zero(), 0);
        for (uint32_t k = 0; k < points; ++k)
            EXPECT_EQ(memory.anchor_a[k].w, 0);
        expectFrame(memory, manifold, bodies[0], bodies[1 + points % 2]);
        expectPlaces(memory, manifold, bodies[0], bodies[1 + points % 2]);
    }
}

TEST(SmallRememberContacts, PointsThatAreFoundAnewTakeTheImpulsesOfTheSameFeatures) {
    Chance chance(8);
    const std::vector<RigidBody> bodies = randomBodies(chance, 2);
    Pair pair = {randomManifold(chance, 0, 1, 3), randomMemory(chance, 0, 1, 4), true, true};
    pair.manifold.points[0].id.x = 103; // as the old contact's last
    pair.manifold.points[1].id.x = 999; // as none
    pair.manifold.points[2].id.x = 100;
    const gpu::ContactMemory memory = rememberOnDevice({pair}, bodies).contacts[0];
    EXPECT_EQ(memory.anchor_a[0].w, pair.old.anchor_a[3].w);
    EXPECT_EQ(memory.anchor_a[1].w, 0);
    EXPECT_EQ(memory.anchor_a[2].w, pair.old.anchor_a[0].w);
    EXPECT_EQ(memory.ids.w, pair.old.ids.w);
    EXPECT_EQ(memory.rub.w, armsOf(bodies[0], bodies[1]));
    expectPlaces(memory, pair.manifold, bodies[0], bodies[1]);
}

// While it does not touch, other contacts of its bodies may take it.
TEST(SmallRememberContacts, APairThatTouchesNoMoreGivesItsColorUp) {
    Chance chance(11);
    const std::vector<RigidBody> bodies = randomBodies(chance, 2);
    const Pair apart = {randomManifold(chance, 0, 1, 0), randomMemory(chance, 0, 1, 3), true, true};
    const Remembered now = rememberOnDevice({apart}, bodies);
    EXPECT_EQ(now.touches[0], 0u);
    EXPECT_EQ(now.contacts[0].ids.w, NO_INDEX);
    const Pair again = {randomManifold(chance, 0, 1, 2), now.contacts[0], true, true};
    EXPECT_EQ(rememberOnDevice({again}, bodies).contacts[0].ids.w, NO_INDEX);
}

// A point that the old contact had no more is not there, though its words may be.
TEST(SmallRememberContacts, PointsTakeNothingFromOnesThatWereNotThere) {
    Chance chance(9);
    const std::vector<RigidBody> bodies = randomBodies(chance, 2);
    Pair pair = {randomManifold(chance, 0, 1, 4), randomMemory(chance, 0, 1, 4), true, true};
    pair.old.ids.z = 2;
    const gpu::ContactMemory memory = rememberOnDevice({pair}, bodies).contacts[0];
    EXPECT_EQ(memory.anchor_a[1].w, pair.old.anchor_a[1].w);
    EXPECT_EQ(memory.anchor_a[2].w, 0);
    EXPECT_EQ(memory.anchor_a[3].w, 0);
}

TEST(SmallRememberContacts, FrictionIsTurnedIntoTheNewPlane) {
    Chance chance(10);
    const std::vector<RigidBody> bodies = randomBodies(chance, 2);
    for (int k = 0; k < 50; ++k) {
        Pair pair = {randomManifold(chance, 0, 1, 2), randomMemory(chance, 0, 1, 2), true, true};
        if (k % 2 == 0) pair.manifold.normal = pair.old.normal;
        const gpu::ContactMemory memory = rememberOnDevice({pair}, bodies).contacts[0];
        const Vector was = slideOf(pair.old), normal = xyz(pair.manifold.normal);
        EXPECT_LE((slideOf(memory) - (was - was.dot(normal) * normal)).norm(), 1e-5);
        EXPECT_EQ(memory.rub.z, pair.old.rub.z);
    }
}

} // namespace
} // namespace kernel_test
