#include "tests/reference/soft_contact.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace reference {
namespace {

constexpr double kNoPull = 1e-3; // of what all points press: what would pull less than that is to press with nothing
constexpr double kDoubt = 0.02;  // of the mean diagonal: speeds that hardly any impulse gives are not asked for

using Four = SoftContact::Four;
using Matrix = std::array<Four, SoftContact::kPoints>;

UnitQuaternion back(const UnitQuaternion& q) { return {-q[0], -q[1], -q[2], q[3]}; }

UnitQuaternion after(const UnitQuaternion& p, const UnitQuaternion& q) {
    const Point u = {p[0], p[1], p[2]}, v = {q[0], q[1], q[2]}, w = p[3] * v + q[3] * u + cross(u, v);
    return {w[0], w[1], w[2], p[3] * q[3] - dot(u, v)};
}

Point rotated(const UnitQuaternion& turn, const Point& v) {
    const UnitQuaternion q = after(after(turn, {v[0], v[1], v[2], 0}), back(turn));
    return {q[0], q[1], q[2]};
}

UnitQuaternion normalized(const UnitQuaternion& q) {
    const double size = std::sqrt(dot({q[0], q[1], q[2]}, {q[0], q[1], q[2]}) + q[3] * q[3]);
    return {q[0] / size, q[1] / size, q[2] / size, q[3] / size};
}

// What turning adds to v: of a small turn, a small number with all its digits.
Point shiftedBy(const UnitQuaternion& turn, const Point& v) {
    const Point axis = {turn[0], turn[1], turn[2]}, side = cross(axis, v);
    return 2.0 * (turn[3] * side + cross(axis, side));
}

Point timesEach(const Point& a, const Point& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }
Point inverseOf(const Point& a) { return {1 / a[0], 1 / a[1], 1 / a[2]}; }

// How much speed along v at one arm an impulse along u at another gives.
double yieldOf(const RigidBody& body, const Point& at, const Point& u, const Point& arm, const Point& v) {
    return body.inverse_mass * dot(u, v) + dot(cross(arm, v), body.spinBy(cross(at, u)));
}

// X of A X = B, by elimination with the largest pivot.
Matrix solved(Matrix a, Matrix b) {
    for (size_t k = 0; k < a.size(); ++k) {
        size_t best = k;
        for (size_t row = k; row < a.size(); ++row)
            if (std::abs(a[row][k]) > std::abs(a[best][k])) best = row;
        std::swap(a[k], a[best]);
        std::swap(b[k], b[best]);
        for (size_t row = 0; row < a.size(); ++row) {
            if (row == k) continue;
            const double share = a[row][k] / a[k][k];
            for (size_t column = 0; column < a.size(); ++column) {
                a[row][column] -= share * a[k][column];
                b[row][column] -= share * b[k][column];
            }
        }
    }
    for (size_t row = 0; row < a.size(); ++row)
        for (double& x : b[row])
            x /= a[row][row];
    return b;
}

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c = {};
    for (size_t i = 0; i < a.size(); ++i)
        for (size_t j = 0; j < a.size(); ++j)
            for (size_t k = 0; k < a.size(); ++k)
                c[i][j] += a[i][k] * b[k][j];
    return c;
}

// An inverse of the matrix A of yields where it has one: A / (A A + d d).
Matrix pressOf(const Matrix& yields) {
    double mean = 0;
    for (size_t k = 0; k < yields.size(); ++k)
        mean += yields[k][k] / static_cast<double>(yields.size());
    Matrix square = product(yields, yields);
    for (size_t k = 0; k < yields.size(); ++k)
        square[k][k] += kDoubt * kDoubt * mean * mean;
    return solved(square, yields);
}

} // namespace

UnitQuaternion RigidBody::turnNow() const { return after(turned, turn); }

Point RigidBody::spinBy(const Point& angular_impulse) const {
    const UnitQuaternion now = turnNow();
    return rotated(now, timesEach(inverse_moments, rotated(back(now), angular_impulse)));
}

void RigidBody::push(const Point& arm, const Point& impulse) {
    velocity = velocity + inverse_mass * impulse;
    twist(cross(arm, impulse));
}

void RigidBody::beginStep() {
    moved = {0, 0, 0};
    turned = kNoTurn;
    spin_taken = spin;
}

// Angular momentum is what a body keeps while nothing touches it, spin what impulses change.
void RigidBody::takeUpSpin() {
    const UnitQuaternion now = turnNow();
    const Point gained = rotated(back(now), spin - spin_taken);
    momentum = momentum + rotated(now, timesEach(inverseOf(inverse_moments), gained));
}

void RigidBody::moveFor(double seconds) {
    if (!moves()) return;
    takeUpSpin();
    const FreeTurning free = {inverseOf(inverse_moments), turnNow(), momentum};
    const UnitQuaternion now = turnAfter(free, seconds);
    turned = after(now, back(turn));
    moved = moved + seconds * velocity;
    spin = spinBy(momentum);
    spin_taken = spin;
}

void RigidBody::endStep() {
    if (!moves()) return;
    takeUpSpin();
    turn = normalized(turnNow());
    place = place + moved;
}

Softness softnessOf(double hertz, double damping, double seconds) {
    const double omega = 2 * std::numbers::pi * hertz, stiffness = seconds * omega * (2 * damping + seconds * omega);
    return {omega / (2 * damping + seconds * omega), stiffness / (1 + stiffness), 1 / (1 + stiffness)};
}

// Where the points are now and what impulses do to the bodies; both stay for all substeps.
void SoftContact::beginStep(const RigidBody& on_a, const RigidBody& on_b) {
    center_a = center_b = {0, 0, 0};
    for (SoftPoint& p : points) {
        center_a = center_a + (1.0 / kPoints) * p.arm_a;
        center_b = center_b + (1.0 / kPoints) * p.arm_b;
        const Point way = on_b.place + rotated(on_b.turn, p.anchor_b) - on_a.place - rotated(on_a.turn, p.anchor_a);
        p.separation_then = dot(normal, way);
    }
    follows = on_a.moves() && on_b.moves();
    slid = follows ? on_b.place + center_b - on_a.place - center_a : Point{0, 0, 0};
    reach = 0;
    for (const SoftPoint& p : points)
        reach += length(p.arm_a - center_a) / kPoints;
    weighPressing(on_a, on_b);
    weighRubbing(on_a, on_b);
}

void SoftContact::weighPressing(const RigidBody& on_a, const RigidBody& on_b) {
    Matrix yields;
    for (size_t i = 0; i < kPoints; ++i) {
        for (size_t j = 0; j < kPoints; ++j)
            yields[i][j] = yieldOf(on_a, points[i].arm_a + slid, normal, points[j].arm_a + slid, normal) +
                           yieldOf(on_b, points[i].arm_b, normal, points[j].arm_b, normal);
        points[i].mass = 1 / yields[i][i];
    }
    press = pressOf(yields);
}

void SoftContact::weighRubbing(const RigidBody& on_a, const RigidBody& on_b) {
    const Point u = tangent, v = cross(normal, tangent);
    const auto yield = [&](const Point& s, const Point& t) {
        return yieldOf(on_a, center_a + slid, s, center_a + slid, t) + yieldOf(on_b, center_b, s, center_b, t);
    };
    const double uu = yield(u, u), uv = yield(u, v), vv = yield(v, v), determinant = uu * vv - uv * uv;
    rub_mass = {vv / determinant, -uv / determinant, uu / determinant};
    twist_mass = 1 / dot(normal, on_a.spinBy(normal) + on_b.spinBy(normal));
}

void SoftContact::applyAgain(RigidBody& on_a, RigidBody& on_b) const {
    for (const SoftPoint& p : points) {
        const Point pressed = p.impulse * normal;
        on_a.push(reachOf(p.arm_a, on_a, on_b), -1.0 * pressed);
        on_b.push(p.arm_b, pressed);
    }
    const Point rubbed = slide * tangent + slide_across * cross(normal, tangent);
    on_a.push(reachOf(center_a, on_a, on_b), -1.0 * rubbed);
    on_b.push(center_b, rubbed);
    on_a.twist(-twist * normal);
    on_b.twist(twist * normal);
}

// From differences of what is small: bodies that fall alike must stay exactly as far apart as they were.
double SoftContact::separationOf(const SoftPoint& p, const RigidBody& on_a, const RigidBody& on_b) const {
    const Point of_a = shiftedBy(on_a.turned, p.arm_a + slid), of_b = shiftedBy(on_b.turned, p.arm_b);
    return p.separation_then + dot(normal, on_b.moved - on_a.moved + of_b - of_a);
}

Point SoftContact::reachOf(const Point& arm_a, const RigidBody& on_a, const RigidBody& on_b) const {
    return follows ? arm_a + slid + on_b.moved - on_a.moved : arm_a;
}

double SoftContact::speedAt(const SoftPoint& p, const RigidBody& on_a, const RigidBody& on_b) const {
    return dot(normal, on_b.velocityAt(p.arm_b) - on_a.velocityAt(reachOf(p.arm_a, on_a, on_b)));
}

// What is apart may close its gap in a substep; what overlaps or presses is pushed, softly, to where it touches, or only kept
// where it is.
SoftContact::Demand SoftContact::demandOf(double separation, double impulse, bool is_stiff, const SolveSettings& settings,
                                          bool with_push) const {
    if (separation > 0 && impulse == 0) return {separation / settings.seconds, 1, 0};
    if (!with_push) return {0, 1, 0};
    const Softness& spring = is_stiff ? settings.stiff : settings.soft;
    return {std::max(spring.push_per_overlap * separation, -settings.fastest_push), spring.mass_share, spring.impulse_share};
}

// All points at once, and none where one would have to pull.
void SoftContact::solveTogether(RigidBody& on_a, RigidBody& on_b, const std::array<Demand, kPoints>& demands) {
    Four lacks, total;
    double pressed = 0;
    for (const SoftPoint& p : points)
        pressed += p.impulse;
    for (size_t k = 0; k < kPoints; ++k) {
        lacks[k] = speedAt(points[k], on_a, on_b) + demands[k].speed;
        if (lacks[k] > 0 && points[k].impulse == 0) lacks[k] = 0;
    }
    for (size_t k = 0; k < kPoints; ++k) {
        double asked = 0;
        for (size_t j = 0; j < kPoints; ++j)
            asked += press[k][j] * lacks[j];
        total[k] = points[k].impulse - demands[k].mass_share * asked - demands[k].impulse_share * points[k].impulse;
        if (total[k] < -kNoPull * pressed) return;
        total[k] = std::max(total[k], 0.0);
    }
    for (size_t k = 0; k < kPoints; ++k) {
        const Point impulse = (total[k] - points[k].impulse) * normal;
        on_a.push(reachOf(points[k].arm_a, on_a, on_b), -1.0 * impulse);
        on_b.push(points[k].arm_b, impulse);
        points[k].impulse = total[k];
    }
}

void SoftContact::solvePoint(SoftPoint& p, RigidBody& on_a, RigidBody& on_b, const Demand& demand) const {
    const double asked = demand.mass_share * p.mass * (speedAt(p, on_a, on_b) + demand.speed);
    const double total = std::max(p.impulse - asked - demand.impulse_share * p.impulse, 0.0);
    on_a.push(reachOf(p.arm_a, on_a, on_b), (p.impulse - total) * normal);
    on_b.push(p.arm_b, (total - p.impulse) * normal);
    p.impulse = total;
}

void SoftContact::resistTwist(RigidBody& on_a, RigidBody& on_b, double most) {
    const double total = std::clamp(twist - twist_mass * dot(normal, on_b.spin - on_a.spin), -most, most);
    on_a.twist((twist - total) * normal);
    on_b.twist((total - twist) * normal);
    twist = total;
}

void SoftContact::resistSliding(RigidBody& on_a, RigidBody& on_b, double most) {
    const Point u = tangent, v = cross(normal, tangent), arm_a = reachOf(center_a, on_a, on_b);
    const Point slip = on_b.velocityAt(center_b) - on_a.velocityAt(arm_a);
    double along = slide - rub_mass[0] * dot(slip, u) - rub_mass[1] * dot(slip, v);
    double across = slide_across - rub_mass[1] * dot(slip, u) - rub_mass[2] * dot(slip, v);
    const double size = std::hypot(along, across), share = size > most ? most / size : 1;
    along *= share;
    across *= share;
    const Point impulse = (along - slide) * u + (across - slide_across) * v;
    on_a.push(arm_a, -1.0 * impulse);
    on_b.push(center_b, impulse);
    slide = along;
    slide_across = across;
}

void SoftContact::solve(RigidBody& on_a, RigidBody& on_b, const SolveSettings& settings, bool with_push) {
    std::array<Demand, kPoints> demands;
    for (size_t k = 0; k < kPoints; ++k) {
        SoftPoint& p = points[k];
        demands[k] = demandOf(separationOf(p, on_a, on_b), p.impulse, !on_a.moves() || !on_b.moves(), settings, with_push);
    }
    solveTogether(on_a, on_b, demands);
    for (size_t k = 0; k < kPoints; ++k)
        solvePoint(points[k], on_a, on_b, demands[k]);
    for (size_t k = kPoints; k-- > 0;)
        solvePoint(points[k], on_a, on_b, demands[k]);
    if (with_push) return;
    double pressed = 0;
    for (const SoftPoint& p : points)
        pressed += p.impulse;
    resistTwist(on_a, on_b, friction * pressed * reach);
    resistSliding(on_a, on_b, friction * pressed);
}

} // namespace reference
