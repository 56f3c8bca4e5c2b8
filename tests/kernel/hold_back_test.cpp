// hold_back, against corners in double precision: how far two boxes may go of a way that leads them into each other.
#include "modules/brittle/dynamics/world_contents.h"
#include "tests/kernel/solver_lab.h"
#include "tests/support/rigid_bodies.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace kernel_test {
namespace {

constexpr double kStep = 1.0 / 60, kMargin = 0.02, kFinest = 1.0 / 4096; // of a step, to which shares are found

struct Mover {
    RigidBody body;
    Vector half;              // of its edges
    Vector moved = {0, 0, 0}; // in the step
    Quaternion turned = Quaternion::Identity();
    double own = 1;      // the share that its own way allows
    bool is_held = true; // by the other one

    double reach() const { return half.norm(); }
    double thickness() const { return std::max(half.minCoeff(), reach() / 4); }
    // How far its corners go in the step.
    double sweep() const { return std::min(1.0, own) * moved.norm() + 2 * turned.vec().norm() * reach(); }
    bool isSwift() const { return body.moves() && sweep() > thickness() / 2; }
    double partAt(double share) const { return is_held ? std::min(share, own) : own; }
    // Turns are shared out along the straight line between quaternions.
    Quaternion turnAt(double share) const {
        const double part = partAt(share);
        const Eigen::Vector4d line = part * turned.coeffs() + (1 - part) * Quaternion::Identity().coeffs();
        return Quaternion(line.normalized()) * turnOf(body.state.turn);
    }
    Vector placeAt(double share) const { return body.place() + partAt(share) * moved; }
    // Of its corners along n: the least and the greatest.
    std::array<double, 2> spanAt(double share, const Vector& n) const {
        const Vector along = turnAt(share).inverse() * n;
        const double size = along.cwiseAbs().dot(half), middle = n.dot(placeAt(share));
        return {middle - size, middle + size};
    }
};

struct Meeting {
    Mover a, b;
    Vector normal; // from A to B
    Vector normalAt(double share) const {
        const Mover& larger = a.reach() > b.reach() ? a : b;
        return larger.turnAt(share) * turnOf(larger.body.state.turn).inverse() * normal;
    }
    double depthAt(double share) const {
        const Vector n = normalAt(share);
        return a.spanAt(share, n)[1] - b.spanAt(share, n)[0];
    }
    double allowed() const {
        const Vector n = normalAt(0); // what is not held has already turned
        const auto of_a = a.spanAt(0, n), of_b = b.spanAt(0, n);
        const double thinner = std::min(of_a[1] - of_a[0], of_b[1] - of_b[0]);
        const double most = std::max(thinner / 4, std::min(kMargin, std::min(a.reach(), b.reach()) / 10));
        const double room = a.body.moves() && b.body.moves() ? most : std::clamp(2 * most - depthAt(0), 0.0, most);
        return std::max(most, depthAt(0) + room / 10);
    }
    bool isSwift() const { return a.isSwift() || b.isSwift(); }
};

Mover randomMover(Chance& chance, bool moves) {
    Mover m;
    m.body = randomBody(chance, moves);
    m.body.state.sector = {0, 0, 0, 0};
    if (chance.oneIn(3)) m.body.state.offset.w *= 1000;
    m.half = {chance.between(0.05, 0.5), chance.between(0.05, 0.5), chance.between(0.05, 0.5)};
    m.body.shape.pieces = {0, 1, std::bit_cast<uint32_t>(static_cast<float>(m.half.minCoeff())), 0};
    m.body.shape.inverse_inertia[2].w = static_cast<float>(m.reach());
    return m;
}

// On its way towards the other one, or not; along the way that it had ahead, or aside of it.
void setOff(Mover& m, Chance& chance, const Vector& towards) {
    if (!m.body.moves()) return;
    m.moved = chance.between(0, 1.5) * towards + chance.inBox(0.2);
    m.turned = turnBy(chance.between(0, 1.2), chance.direction());
    const Vector aside = chance.oneIn(4) ? chance.inBox(1) : Vector::Zero(), ahead = m.moved + aside;
    m.body.state.velocity = wordsOf(ahead / kStep);
    const double along = std::clamp(m.moved.dot(ahead) / ahead.squaredNorm(), 0.0, 1.25);
    const double off = (m.moved - along * ahead).norm();
    m.own = off > m.thickness() ? m.thickness() / off : 1;
}

// What is much lighter holds only what is twice as swift.
bool isHeldBy(const Mover& other, const Mover& m) {
    const bool light = other.body.moves() && 0.01 * double{other.body.state.offset.w} > double{m.body.state.offset.w};
    return !light || m.sweep() > m.thickness();
}

Meeting randomMeeting(Chance& chance) {
    Meeting meeting;
    meeting.a = randomMover(chance, chance.below(4) != 0);
    meeting.b = randomMover(chance, chance.below(4) != 0 || !meeting.a.body.moves());
    meeting.normal = chance.direction();
    const double apart =
        chance.between(-0.02, 0.5) + meeting.a.spanAt(0, meeting.normal)[1] - meeting.b.spanAt(0, meeting.normal)[0];
    const Vector place = meeting.b.body.place() + apart * meeting.normal;
    meeting.b.body.state.offset = wordsOf(place, double{meeting.b.body.state.offset.w});
    setOff(meeting.a, chance, meeting.normal);
    setOff(meeting.b, chance, -meeting.normal);
    meeting.a.is_held = isHeldBy(meeting.b, meeting.a);
    meeting.b.is_held = isHeldBy(meeting.a, meeting.b);
    return meeting;
}

gpu::SolverBody solved(const Mover& m) {
    gpu::SolverBody s = solverBodyOf(m.body);
    s.moved = wordsOf(m.moved, double{s.moved.w});
    s.turned = wordsOf(m.turned);
    return s;
}

// Of a way that a body may go, and that what does not move leaves it.
struct Shares {
    float all, still;
};

// Body 2 k meets body 2 k + 1.
std::vector<Shares> heldOnDevice(const std::vector<Meeting>& meetings) {
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
                         moving = bufferOf(solver_bodies), shares = bufferOf(std::vector<float>(2 * bodies.size(), 1.0f));
    onDevice([&](engine::Commands& commands) {
        const std::array<float, 5> push = {0, 0, 0, static_cast<float>(kStep), static_cast<float>(kMargin)};
        commands.dispatch(kernel("hold_back"), count, push,
                          {counts.words, list, near, known, at, records, vertices, states, shapes, moving, shares});
    });
    return valuesOf<Shares>(shares, bodies.size());
}

// The share that a meeting leaves to those that it holds.
double shareOf(const Meeting& m, const Shares& a, const Shares& b) {
    EXPECT_TRUE(m.a.is_held || m.b.is_held);
    const double share = double{m.a.is_held ? a.all : b.all};
    EXPECT_EQ(double{a.all}, m.a.is_held ? share : 1.0) << "both stop at one time, if they are held";
    EXPECT_EQ(double{b.all}, m.b.is_held ? share : 1.0) << "both stop at one time, if they are held";
    EXPECT_EQ(a.still, m.b.body.moves() ? 1.0f : a.all);
    EXPECT_EQ(b.still, m.a.body.moves() ? 1.0f : b.all);
    return share;
}

TEST(SmallHoldBack, StopsBodiesWhereTheyWouldGoTooDeepAndNoOthers) {
    for (const uint32_t count : kSizes) {
        Chance chance(count);
        std::vector<Meeting> meetings;
        for (uint32_t k = 0; k < count; ++k)
            meetings.push_back(randomMeeting(chance));
        const std::vector<Shares> shares = heldOnDevice(meetings);
        uint32_t held = 0, free = 0;
        for (uint32_t k = 0; k < count; ++k) {
            const Meeting& m = meetings[k];
            const double share = shareOf(m, shares[2 * k], shares[2 * k + 1]), allowed = m.allowed(), doubt = 1e-4;
            free += m.a.is_held && m.b.is_held ? 0 : 1;
            if (!m.isSwift() || m.depthAt(1) < allowed - doubt) {
                EXPECT_EQ(share, 1) << k;
            }
            EXPECT_TRUE(!m.isSwift() || share == 0 || m.depthAt(share) < allowed + doubt) << k;
            if (share == 1) continue;
            ++held;
            EXPECT_GT(m.depthAt(share + kFinest), allowed - doubt) << k << ": could go further than " << share;
        }
        EXPECT_TRUE(count < 100 || (held > count / 10 && held < count)) << held << " of " << count;
        EXPECT_TRUE(count < 100 || (free > count / 50 && free < count / 2)) << "held up by nothing so light: " << free;
    }
}

} // namespace
} // namespace kernel_test
