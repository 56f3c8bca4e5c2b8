// push_bodies begins a substep with gravity and the impulses of the one before, keep_impulses ends a step by noting them down.
#include "tests/kernel/solver_lab.h"

#include <algorithm>
#include <set>

namespace kernel_test {
namespace {

constexpr double kSubstep = 1.0 / 240;

gpu::SolverContact randomContact(Chance& chance, uint32_t a, uint32_t b) {
    gpu::SolverContact contact{};
    const Vector normal = chance.direction();
    contact.ids = {a, b, 1 + chance.below(4), 0};
    contact.normal = wordsOf(normal, 0.5);
    contact.tangent = wordsOf(normal.unitOrthogonal());
    contact.center_a = wordsOf(chance.inBox(0.5));
    contact.center_b = wordsOf(chance.inBox(0.5));
    contact.rub = wordsOf(chance.inBox(1));
    for (uint32_t k = 0; k < contact.ids.z; ++k) {
        contact.points[k].arm_a = wordsOf(chance.inBox(0.5));
        contact.points[k].arm_b = wordsOf(chance.inBox(0.5));
        contact.points[k].pulse = {static_cast<float>(chance.between(0, 2)), 0, 0, 0};
    }
    return contact;
}

void noteBlow(gpu::SolverContact& contact, uint32_t point) { contact.points[point].pulse.w += static_cast<float>(POINT_HIT); }

bool isBlow(const gpu::SolverContact& contact) {
    for (uint32_t k = 0; k < contact.ids.z; ++k)
        if (contact.points[k].pulse.w >= POINT_HIT) return true;
    return false;
}

struct Push {
    Vector impulse = Vector::Zero(), twist = Vector::Zero();
    void add(const Vector& force, const Vector& arm) {
        impulse += force;
        twist += arm.cross(force);
    }
};

// On body B; on A it is the opposite at the same point, wherever the two have moved to. What a point was hit with counts no
// more, and friction no more where any point was hit.
Push pushOf(const gpu::SolverContact& c, bool on_b, const Vector& moved) {
    Push push;
    const bool follows = c.rub_mass.w == static_cast<float>(on_b ? ARMS_OF_B_FOLLOW : ARMS_OF_A_FOLLOW);
    const Vector grown = follows ? Vector(on_b ? -moved : moved) : Vector::Zero();
    const double sign = on_b ? 1 : -1;
    const Vector normal = xyz(c.normal), tangent = xyz(c.tangent);
    for (uint32_t k = 0; k < c.ids.z; ++k)
        if (c.points[k].pulse.w < POINT_HIT)
            push.add(sign * double{c.points[k].pulse.x} * normal, grown + xyz(on_b ? c.points[k].arm_b : c.points[k].arm_a));
    if (isBlow(c)) return push;
    push.add(sign * (double{c.rub.x} * tangent + double{c.rub.y} * normal.cross(tangent)),
             grown + xyz(on_b ? c.center_b : c.center_a));
    push.twist += sign * double{c.rub.z} * normal;
    return push;
}

struct Heap {
    std::vector<RigidBody> bodies;
    std::vector<Vector> moved; // since the step began
    std::vector<gpu::SolverContact> contacts;
    Push pushOn(uint32_t entry) const {
        const gpu::SolverContact& c = contacts[entry / 2];
        return pushOf(c, entry % 2 == 1, moved[c.ids.y] - moved[c.ids.x]);
    }
    std::vector<uint32_t> start = {0}, adjacency; // as order_adjacency makes them
};

Heap pressedHeap(uint32_t body_count, uint32_t contact_count, uint32_t seed) {
    Chance chance(seed);
    Heap heap;
    for (uint32_t b = 0; b < body_count; ++b) {
        heap.bodies.push_back(randomBody(chance, b % 6 != 0));
        heap.moved.push_back(heap.bodies[b].moves() ? chance.inBox(0.1) : Vector::Zero());
    }
    for (uint32_t c = 0; c < contact_count; ++c) {
        const uint32_t a = chance.below(body_count);
        heap.contacts.push_back(randomContact(chance, a, (a + 1 + chance.below(5)) % body_count));
        gpu::SolverContact& contact = heap.contacts.back();
        const bool both_move = heap.bodies[contact.ids.x].moves() && heap.bodies[contact.ids.y].moves();
        contact.rub_mass.w = !both_move ? ARMS_STAY : chance.oneIn(2) ? ARMS_OF_A_FOLLOW : ARMS_OF_B_FOLLOW;
        for (gpu::SolverPoint& point : contact.points)
            point.pulse.w = chance.oneIn(2) ? POINT_FREE : POINT_PRESSED;
        if (c % 5 == 0) noteBlow(heap.contacts.back(), chance.below(heap.contacts.back().ids.z));
    }
    for (uint32_t b = 0; b < body_count; ++b) {
        for (uint32_t c = 0; c < contact_count && heap.bodies[b].moves(); ++c)
            for (const uint32_t side : {0u, 1u})
                if ((side == 0 ? heap.contacts[c].ids.x : heap.contacts[c].ids.y) == b) heap.adjacency.push_back(2 * c + side);
        heap.start.push_back(static_cast<uint32_t>(heap.adjacency.size()));
    }
    return heap;
}

// As color_contacts leaves them: each body is an island of its own here, of a few contacts or of too many.
std::vector<uint32_t> islandContacts(const Heap& heap, const std::set<uint32_t>& small) {
    std::vector<uint32_t> contacts(heap.bodies.size(), NO_INDEX);
    for (const uint32_t body : small)
        contacts[body] = 7;
    return contacts;
}

// `small`: bodies whose islands are stepped on their own.
std::vector<gpu::SolverBody> pushedOnDevice(const Heap& heap, const Vector& gravity, uint32_t failed = 0, uint32_t made = 1,
                                            const std::set<uint32_t>& small = {}) {
    Counts counts;
    counts[STATUS_FAILED] = failed;
    gpu::SolverPush push{};
    push.gravity = wordsOf(gravity, kSubstep);
    push.first_substep = 1;
    const auto bodies_in_all = static_cast<uint32_t>(heap.bodies.size());
    counts[COUNT_BODIES] = bodies_in_all;
    std::vector<gpu::SolverBody> solver_bodies = solverBodiesOf(heap.bodies);
    for (uint32_t b = 0; b < bodies_in_all; ++b)
        solver_bodies[b].moved = wordsOf(heap.moved[b], double{solver_bodies[b].moved.w});
    const engine::Buffer contacts = bufferOf(heap.contacts), start = bufferOf(heap.start), adjacency = bufferOf(heap.adjacency),
                         bodies = bufferOf(solver_bodies), steps = bufferOf(std::vector<uint32_t>{made, 0, 0, 0}),
                         islands = bufferOf(countUp(bodies_in_all)), island_contacts = bufferOf(islandContacts(heap, small));
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(kernel("push_bodies"), bodies_in_all, push,
                          {counts.words, contacts, start, adjacency, bodies, steps, islands, island_contacts});
    });
    return valuesOf<gpu::SolverBody>(bodies, heap.bodies.size());
}

TEST(SmallPushBodies, GiveThemGravityAndTheImpulsesOfTheirContactsOnceMore) {
    for (const uint32_t count : {7u, 64u, 65u, 500u}) {
        const Heap heap = pressedHeap(count, 3 * count, count);
        const Vector gravity(1, -9.81, 0.5);
        const std::vector<gpu::SolverBody> pushed = pushedOnDevice(heap, gravity);
        for (uint32_t b = 0; b < count; ++b) {
            const RigidBody& body = heap.bodies[b];
            Push sum;
            for (uint32_t k = heap.start[b]; k < heap.start[b + 1]; ++k) {
                const Push one = heap.pushOn(heap.adjacency[k]);
                sum.impulse += one.impulse;
                sum.twist += one.twist;
            }
            const Vector velocity =
                body.moves() ? Vector(xyz(body.state.velocity) + kSubstep * gravity + double{body.state.offset.w} * sum.impulse)
                             : xyz(body.state.velocity);
            const Vector spin = xyz(body.state.spin) + body.inverseInertia() * sum.twist;
            EXPECT_LE((xyz(pushed[b].velocity) - velocity).norm(), 1e-5 * (1 + velocity.norm())) << b;
            EXPECT_LE((xyz(pushed[b].spin) - spin).norm(), 1e-5 * (1 + spin.norm())) << b;
        }
    }
}

// Speeds lag by half a substep from the first step on, but for those of what touches something.
TEST(SmallPushBodies, InTheFirstStepGiveWhatTouchesGravityForAHalfMore) {
    Heap heap = pressedHeap(64, 40, 5);
    for (gpu::SolverContact& contact : heap.contacts)
        contact = {contact.ids};
    const Vector gravity(0, -9.81, 3);
    const auto first = pushedOnDevice(heap, gravity, 0, 0), later = pushedOnDevice(heap, gravity);
    uint32_t touching = 0;
    for (uint32_t b = 0; b < 64; ++b) {
        const bool touches = heap.start[b] < heap.start[b + 1] && heap.bodies[b].moves();
        const Vector more = xyz(first[b].velocity) - xyz(later[b].velocity);
        EXPECT_LE((more - (touches ? 0.5 : 0) * kSubstep * gravity).norm(), 1e-6) << b;
        touching += touches ? 1 : 0;
    }
    EXPECT_GT(touching, 10u);
    EXPECT_LT(touching, 60u);
}

// What one body gets the other one loses, about the origin, wherever the two have moved to and whosever arms follow.
TEST(SmallPushBodies, KeepTheMomentumOfAllBodiesThatMove) {
    for (const int arms : {ARMS_OF_A_FOLLOW, ARMS_OF_B_FOLLOW}) {
        Heap heap = pressedHeap(2, 0, 1);
        Chance chance(2);
        heap.bodies[0] = randomBody(chance, true);
        heap.bodies[1] = randomBody(chance, true);
        heap.moved = {chance.inBox(0.1), chance.inBox(0.1)};
        heap.contacts = {randomContact(chance, 0, 1)};
        heap.contacts[0].rub_mass.w = static_cast<float>(arms);
        const Vector way = heap.bodies[1].place() - heap.bodies[0].place();
        for (gpu::SolverPoint& point : heap.contacts[0].points)
            point.arm_a = wordsOf(way + xyz(point.arm_b));
        heap.contacts[0].center_a = wordsOf(way + xyz(heap.contacts[0].center_b));
        heap.adjacency = {0, 1};
        heap.start = {0, 1, 2};
        const std::vector<gpu::SolverBody> pushed = pushedOnDevice(heap, {0, 0, 0});
        Vector momentum = Vector::Zero(), angular = Vector::Zero();
        for (uint32_t b = 0; b < 2; ++b) {
            const RigidBody& body = heap.bodies[b];
            const Vector gained = (xyz(pushed[b].velocity) - xyz(body.state.velocity)) / double{body.state.offset.w};
            momentum += gained;
            angular += (body.place() + heap.moved[b]).cross(gained);
            angular += body.inverseInertia().inverse() * (xyz(pushed[b].spin) - xyz(body.state.spin));
        }
        EXPECT_LE(momentum.norm(), 1e-4);
        EXPECT_LE(angular.norm(), 1e-4);
    }
}

TEST(SmallPushBodies, LeaveThemAloneIfTheStepFailed) {
    const Heap heap = pressedHeap(30, 60, 3);
    const std::vector<gpu::SolverBody> pushed = pushedOnDevice(heap, {0, -9.81, 0}, FAILED_CAPACITY);
    for (uint32_t b = 0; b < 30; ++b) {
        EXPECT_EQ(xyz(pushed[b].velocity), xyz(heap.bodies[b].state.velocity));
        EXPECT_EQ(xyz(pushed[b].spin), xyz(heap.bodies[b].state.spin));
    }
}

TEST(SmallPushBodies, LeaveThemToTheirSmallIslands) {
    const Heap heap = pressedHeap(30, 60, 4);
    const std::vector<gpu::SolverBody> all = pushedOnDevice(heap, {0, -9.81, 0}),
                                       some = pushedOnDevice(heap, {0, -9.81, 0}, 0, 1, {1, 5, 8});
    for (uint32_t b = 0; b < 30; ++b) {
        const bool small = b == 1 || b == 5 || b == 8;
        EXPECT_EQ(xyz(some[b].velocity), small ? xyz(heap.bodies[b].state.velocity) : xyz(all[b].velocity)) << b;
    }
}

TEST(SmallKeepImpulses, NoteWhatContactsWerePressedWithAndInHowManySubsteps) {
    for (const uint32_t count : kSizes) {
        Heap heap = pressedHeap(20, count, count);
        for (uint32_t c = 0; c < count; ++c) {
            heap.contacts[c].ids.w = 2 * (count - c); // remembered in some other order
            heap.contacts[c].pace = {0, 4 + c, 0, 0};
        }
        Counts counts;
        counts[COUNT_CONTACTS] = count;
        const engine::Buffer contacts = bufferOf(heap.contacts),
                             memory = bufferOf(std::vector<gpu::ContactMemory>(2 * count + 1));
        onDevice([&](engine::Commands& commands) {
            commands.dispatch(kernel("keep_impulses"), count, engine::NoPush{}, {counts.words, contacts, memory});
        });
        for (const gpu::SolverContact& contact : heap.contacts) {
            const gpu::ContactMemory& kept = memory.mappedAs<gpu::ContactMemory>()[contact.ids.w];
            EXPECT_EQ(xyz(kept.rub), isBlow(contact) ? Vector(0, 0, 0) : xyz(contact.rub));
            EXPECT_EQ(kept.pace.x, contact.pace.y);
            for (uint32_t k = 0; k < contact.ids.z; ++k) {
                const bool blow = contact.points[k].pulse.w >= POINT_HIT;
                EXPECT_EQ(kept.anchor_a[k].w, blow ? 0 : contact.points[k].pulse.x);
                EXPECT_EQ(kept.arm_b[k].w == HIT_LAST, blow);
            }
        }
    }
}

} // namespace
} // namespace kernel_test
