// hold_back, against corners in double precision: how far two boxes may go of a way that leads them into each other, and what
// slows those that hang in each other.
#include "modules/brittle/dynamics/world_contents.h"
#include "tests/kernel/solver_lab.h"
#include "tests/support/rigid_bodies.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace kernel_test {
namespace {

constexpr double kStep = 1.0 / 60, kMargin = 0.02, kFinest = 1.0 / 4096; // of a step, to which shares are found

// Of the way that a body is to go, and of the turn.
struct Shares {
    double way = 1, turn = 1;
    auto operator<=>(const Shares&) const = default;
};

struct Mover {
    RigidBody body;
    Vector half;              // of its edges
    Vector moved = {0, 0, 0}; // in the step
    Quaternion turned = Quaternion::Identity();
    double own = 1;       // the share that its own way allows
    bool is_held = false; // by the other one

    double inverseMass() const { return double{body.state.offset.w}; }
    double thickness() const { return std::max(half.minCoeff(), reach() / 4); }
    double reach() const { return half.norm(); }
    // Turns are shared out along the straight line between quaternions.
    Quaternion turnAt(double share) const {
        const double part = partOf(share);
        const Eigen::Vector4d line = part * turned.coeffs() + (1 - part) * Quaternion::Identity().coeffs();
        return Quaternion(line.normalized()) * turnOf(body.state.turn);
    }
    double partOf(double share) const { return is_held ? std::min(share, own) : own; }
    Vector placeAt(double share) const { return body.place() + partOf(share) * moved; }
    // Fast for its thickness, by twice as much where the other is much lighter.
    bool isHeldBy(const Mover& other) const {
        const bool light = other.inverseMass() * 0.01 > inverseMass();
        const double way = own * moved.norm() + 2 * turned.vec().norm() * reach();
        return body.moves() && way > (light ? 1 : 0.5) * thickness();
    }
    // Of its corners along n: the least and the greatest.
    std::array<double, 2> spanAt(const Shares& share, const Vector& n) const {
        const Vector along = turnAt(share.turn).inverse() * n;
        const double size = along.cwiseAbs().dot(half), middle = n.dot(placeAt(share.way));
        return {middle - size, middle + size};
    }
};

Matrix ownInertia(const Mover& m) {
    const auto& rows = m.body.shape.inverse_inertia;
    return Vector(1.0 / rows[0].x, 1.0 / rows[1].y, 1.0 / rows[2].z).asDiagonal();
}

struct Meeting {
    Mover a, b;
    Vector normal; // from A to B
    Vector normalAt(const Shares& share) const {
        const Mover& larger = a.reach() > b.reach() ? a : b;
        return larger.turnAt(share.turn) * turnOf(larger.body.state.turn).inverse() * normal;
    }
    double depthAt(const Shares& share) const {
        const Vector n = normalAt(share);
        return a.spanAt(share, n)[1] - b.spanAt(share, n)[0];
    }
    double allowed() const {
        const Shares begin = {0, 0};
        const Vector n = normalAt(begin); // what is not held is where it ends
        const auto of_a = a.spanAt(begin, n), of_b = b.spanAt(begin, n);
        const double thinner = std::min(of_a[1] - of_a[0], of_b[1] - of_b[0]), depth = depthAt(begin);
        const double most = std::max(thinner / 4, std::min(kMargin, std::min(a.reach(), b.reach()) / 10));
        const bool both_move = a.body.moves() && b.body.moves();
        return std::max(most, depth + (both_move ? most : std::clamp(2 * most - depth, 0.0, most)) / 10);
    }
};

Mover randomMover(Chance& chance, bool moves) {
    Mover m;
    m.body = randomBody(chance, moves);
    m.body.state.sector = {0, 0, 0, 0};
    m.half = {chance.between(0.05, 0.5), chance.between(0.05, 0.5), chance.between(0.05, 0.5)};
    m.body.shape.pieces = {0, 1, std::bit_cast<uint32_t>(static_cast<float>(m.half.minCoeff())), 0};
    m.body.shape.inverse_inertia[2].w = static_cast<float>(m.reach());
    return m;
}

// On its way towards the other one, or not; along the way that it had ahead, or aside of it.
void setOff(Mover& m, Chance& chance, const Vector& towards) {
    if (!m.body.moves()) return;
    const double pace = chance.oneIn(3) ? 0.05 : 1;
    m.moved = pace * (chance.between(0, 1.5) * towards + chance.inBox(0.2));
    m.turned = turnBy(pace * chance.between(0, 1.2), chance.direction());
    const Vector aside = chance.oneIn(4) ? chance.inBox(1) : Vector::Zero(), ahead = m.moved + aside;
    m.body.state.velocity = wordsOf(ahead / kStep);
    const double along = std::clamp(m.moved.dot(ahead) / ahead.squaredNorm(), 0.0, 1.25);
    const double off = (m.moved - along * ahead).norm();
    m.own = off > m.thickness() ? m.thickness() / off : 1;
}

// Of a body of the same size and another density.
void weigh(Mover& m, double times) {
    m.body.state.offset.w /= static_cast<float>(times);
    for (gpu::vec4& row : m.body.shape.inverse_inertia)
        for (float* inverse : {&row.x, &row.y, &row.z})
            *inverse /= static_cast<float>(times);
}

Meeting randomMeeting(Chance& chance) {
    Meeting meeting;
    meeting.a = randomMover(chance, chance.below(4) != 0);
    meeting.b = randomMover(chance, chance.below(4) != 0 || !meeting.a.body.moves());
    if (chance.oneIn(3)) weigh(meeting.b, 1e-4);
    meeting.normal = chance.direction();
    const double apart =
        chance.between(-0.02, 0.5) + meeting.a.spanAt({0, 0}, meeting.normal)[1] - meeting.b.spanAt({0, 0}, meeting.normal)[0];
    const Vector place = meeting.b.body.place() + apart * meeting.normal;
    meeting.b.body.state.offset = wordsOf(place, double{meeting.b.body.state.offset.w});
    setOff(meeting.a, chance, meeting.normal);
    setOff(meeting.b, chance, -meeting.normal);
    meeting.a.is_held = meeting.a.isHeldBy(meeting.b);
    meeting.b.is_held = meeting.b.isHeldBy(meeting.a);
    return meeting;
}

gpu::SolverBody solved(const Mover& m) {
    gpu::SolverBody s = solverBodyOf(m.body);
    s.moved = wordsOf(m.moved, double{s.moved.w});
    s.turned = wordsOf(m.turned);
    return s;
}

struct Held {
    std::vector<Shares> shares; // of bodies
    std::vector<gpu::StopImpulse> stops;
};

// Body 2 k meets body 2 k + 1, and nothing else.
Held heldOnDevice(const std::vector<Meeting>& meetings) {
    brittle::HullSet hulls;
    std::vector<gpu::PieceRecord> pieces;
    std::vector<RigidBody> bodies;
    std::vector<gpu::SolverBody> solver_bodies;
    std::vector<Word2> pairs;
    std::vector<gpu::ContactMemory> memory;
    for (const Meeting& m : meetings) {
        const auto first = static_cast<uint32_t>(bodies.size());
        pairs.push_back({first, first + 1});
        gpu::ContactMemory contact{};
        contact.ids = {first, first + 1, 1, 0};
        contact.normal = wordsOf(m.normal);
        contact.turn_a = m.a.body.state.turn;
        contact.turn_b = m.b.body.state.turn;
        memory.push_back(contact);
        for (const Mover* mover : {&m.a, &m.b}) {
            const brittle::PieceShape box = support::boxPiece({2 * mover->half.x(), 2 * mover->half.y(), 2 * mover->half.z()});
            pieces.push_back({{*brittle::addHull(hulls, box.vertices, box.loops), static_cast<uint32_t>(bodies.size()), 0, 0}});
            bodies.push_back(mover->body);
            solver_bodies.push_back(solved(*mover));
        }
    }
    const auto count = static_cast<uint32_t>(meetings.size());
    Counts counts;
    counts[COUNT_SWIFT] = count;
    const engine::Buffer list = bufferOf(countUp(count)), near = bufferOf(pairs), known = bufferOf(memory),
                         at = bufferOf(pieces), records = bufferOf(hulls.records), vertices = bufferOf(hulls.vertices),
                         states = bufferOf(statesOf(bodies)), shapes = bufferOf(shapesOf(bodies)),
                         moving = bufferOf(solver_bodies), shares = bufferOf(std::vector<float>(2 * bodies.size(), 1.0f)),
                         starts = bufferOf(countUp(2 * count + 1)), stops = blankBuffer<gpu::StopImpulse>(count);
    onDevice([&](engine::Commands& commands) {
        const std::array<float, 5> push = {0, 0, 0, static_cast<float>(kStep), static_cast<float>(kMargin)};
        commands.dispatch(
            kernel("hold_back"), count, push,
            {counts.words, list, near, known, at, records, vertices, states, shapes, moving, shares, list, starts, stops});
    });
    Held held = {{}, valuesOf<gpu::StopImpulse>(stops, count)};
    for (const Word2& both : valuesOf<Word2>(shares, 2 * count))
        held.shares.push_back({double{std::bit_cast<float>(both[0])}, double{std::bit_cast<float>(both[1])}});
    return held;
}

std::vector<Meeting> randomMeetings(uint32_t count) {
    Chance chance(count);
    std::vector<Meeting> meetings;
    for (uint32_t k = 0; k < count; ++k)
        meetings.push_back(randomMeeting(chance));
    return meetings;
}

constexpr double kDoubt = 1e-4; // m
constexpr Shares kAll = {1, 1}, kWithoutTurn = {1, 0};

// All of the way and less of the turn, if that is enough; else less of both.
void expectFurthest(const Meeting& m, const Shares& share) {
    const double allowed = m.allowed();
    EXPECT_LE(m.depthAt(share), allowed + kDoubt);
    if (share.way == 1) {
        EXPECT_GT(m.depthAt({1, share.turn + kFinest}), allowed - kDoubt) << "could turn further than " << share.turn;
    } else {
        EXPECT_EQ(share.way, share.turn);
        EXPECT_GT(m.depthAt(kWithoutTurn), allowed - kDoubt) << "could go all of its way";
        EXPECT_GT(m.depthAt({share.way + kFinest, share.way + kFinest}), allowed - kDoubt)
            << "could go further than " << share.way;
    }
}

TEST(SmallHoldBack, StopsBodiesWhereTheyWouldGoTooDeepAndNoOthers) {
    for (const uint32_t count : kSizes) {
        const std::vector<Meeting> meetings = randomMeetings(count);
        const std::vector<Shares> shares = heldOnDevice(meetings).shares;
        uint32_t held = 0, turns_less = 0, one_of_two = 0;
        for (uint32_t k = 0; k < count; ++k) {
            SCOPED_TRACE(k);
            const Meeting& m = meetings[k];
            const Shares &of_a = shares[2 * k], &of_b = shares[2 * k + 1], &share = m.a.is_held ? of_a : of_b;
            if (!m.a.is_held) {
                EXPECT_EQ(of_a, kAll);
            }
            if (!m.b.is_held) {
                EXPECT_EQ(of_b, kAll);
            }
            if (m.a.is_held && m.b.is_held) {
                EXPECT_EQ(of_a, of_b) << "both stop at one time";
            }
            if (share == kAll) {
                EXPECT_LE(m.a.is_held || m.b.is_held ? m.depthAt(kAll) : -1, m.allowed() + kDoubt);
                continue;
            }
            expectFurthest(m, share);
            ++held;
            turns_less += share.way == 1 ? 1 : 0;
            one_of_two += m.a.is_held != m.b.is_held && m.a.body.moves() && m.b.body.moves() ? 1 : 0;
        }
        EXPECT_TRUE(count < 100 || (held > count / 10 && held < count)) << held << " of " << count;
        EXPECT_TRUE(count < 1000 || (turns_less > count / 100 && one_of_two > count / 100)) << turns_less << ", " << one_of_two;
    }
}

double energyOf(const Mover& m, const Vector& velocity, const Vector& spin) {
    if (!m.body.moves()) return 0;
    const Matrix inertia = m.turnAt(1).toRotationMatrix() * ownInertia(m) * m.turnAt(1).toRotationMatrix().transpose();
    return 0.5 * (velocity.squaredNorm() / m.inverseMass() + spin.dot(inertia * spin));
}

struct Motion {
    Vector velocity, spin;
};

// With the inertia that it has at the end of the step, as the solver has it.
Motion pushed(const Mover& m, const Vector& impulse, const Vector& twist) {
    const Motion was = {xyz(m.body.state.velocity), xyz(m.body.state.spin)};
    if (!m.body.moves()) return was;
    const Matrix axes = m.turnAt(1).toRotationMatrix();
    return {was.velocity + m.inverseMass() * impulse, was.spin + axes * ownInertia(m).inverse() * axes.transpose() * twist};
}

TEST(SmallHoldBack, SlowsWhatHangsInSomethingAndKeepsItsMomentum) {
    std::vector<Meeting> meetings = randomMeetings(1000);
    for (Meeting& m : meetings)
        for (Mover* mover : {&m.a, &m.b}) {
            mover->own = 1;
            mover->body.state.sector.w = BODY_HELD;
        }
    const Held out = heldOnDevice(meetings);
    uint32_t slowed = 0;
    for (uint32_t k = 0; k < meetings.size(); ++k) {
        SCOPED_TRACE(k);
        const Meeting& m = meetings[k];
        const gpu::StopImpulse& stop = out.stops[k];
        const Vector impulse = xyz(stop.impulse), twist = xyz(stop.twist), back = xyz(stop.back);
        if (impulse.isZero() && twist.isZero()) continue;
        const bool of_b = stop.impulse.w == 1;
        const Mover &slowed_one = of_b ? m.b : m.a, &other = of_b ? m.a : m.b;
        ASSERT_TRUE(slowed_one.is_held);
        ASSERT_FALSE(other.is_held) << "two that stop at one time keep their velocities";
        const Vector way = slowed_one.body.place() - other.body.place();
        EXPECT_LT((twist + back + way.cross(impulse)).norm(), 1e-4 * (twist.norm() + way.norm() * impulse.norm()));
        const Motion first = pushed(slowed_one, impulse, twist), second = pushed(other, -impulse, back);
        const double before = energyOf(slowed_one, xyz(slowed_one.body.state.velocity), xyz(slowed_one.body.state.spin)) +
                              energyOf(other, xyz(other.body.state.velocity), xyz(other.body.state.spin));
        EXPECT_LE(energyOf(slowed_one, first.velocity, first.spin) + energyOf(other, second.velocity, second.spin),
                  before * (1 + 1e-5));
        ++slowed;
    }
    EXPECT_GT(slowed, 100u);
}

TEST(SmallHoldBack, SlowsNothingThatWasNotHeldBefore) {
    for (const gpu::StopImpulse& stop : heldOnDevice(randomMeetings(1000)).stops)
        ASSERT_TRUE(xyz(stop.impulse).isZero() && xyz(stop.twist).isZero() && xyz(stop.back).isZero());
}

} // namespace
} // namespace kernel_test
