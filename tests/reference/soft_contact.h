// Two bodies on each other by four points, solved by soft sequential impulses in double precision: the method that
// shaders-spirv/shared/solver.h describes, one number after the other. Restitution is none.
#pragma once

#include "tests/reference/rigid_motion.h"

namespace reference {

constexpr UnitQuaternion kNoTurn = {0, 0, 0, 1};

// `moved` and `turned` are since the step began; a body of no inverse mass has no inverse moments either and stays.
struct RigidBody {
    double inverse_mass = 0;
    Point inverse_moments = {0, 0, 0}; // about the own axes
    Point place = {0, 0, 0};
    UnitQuaternion turn = kNoTurn;
    Point velocity = {0, 0, 0}, spin = {0, 0, 0};
    Point momentum = {0, 0, 0};   // angular
    Point spin_taken = {0, 0, 0}; // the spin that the momentum was last brought up to
    Point moved = {0, 0, 0};
    UnitQuaternion turned = kNoTurn;

    bool moves() const { return inverse_mass > 0; }
    void beginStep();
    void moveFor(double seconds);
    void endStep();
    void push(const Point& arm, const Point& impulse);
    void twist(const Point& angular_impulse) { spin = spin + spinBy(angular_impulse); }
    Point velocityAt(const Point& arm) const { return velocity + cross(spin, arm); }
    Point spinBy(const Point& angular_impulse) const; // what it adds to the spin

private:
    UnitQuaternion turnNow() const;
    void takeUpSpin();
};

// How overlap is pushed out: by a spring that is damped.
struct Softness {
    double push_per_overlap = 0, mass_share = 0, impulse_share = 0;
};
Softness softnessOf(double hertz, double damping, double seconds);

struct SolveSettings {
    Point gravity = {0, 0, 0};
    double seconds = 0;      // of a substep
    Softness soft, stiff;    // the latter where one of the two does not move
    double fastest_push = 0; // m/s
};

struct SoftPoint {
    Point anchor_a, anchor_b; // own axes
    Point arm_a, arm_b;       // world axes; of the moment when it was found
    double impulse = 0;
    double separation_then = 0; // when the step began
    double mass = 0;
};

struct SoftContact {
    static constexpr size_t kPoints = 4;
    using Four = std::array<double, kPoints>;

    size_t a = 0, b = 0;
    size_t color = 0;
    double friction = 0;
    Point normal = {0, 0, 0}, tangent = {0, 0, 0}; // the normal from A to B
    std::array<SoftPoint, kPoints> points;
    double slide = 0, slide_across = 0, twist = 0; // impulses of friction

    void beginStep(const RigidBody& on_a, const RigidBody& on_b);
    void applyAgain(RigidBody& on_a, RigidBody& on_b) const; // the impulses of the substep before
    void solve(RigidBody& on_a, RigidBody& on_b, const SolveSettings& settings, bool with_push);

private:
    struct Demand {
        double speed, mass_share, impulse_share;
    };
    Demand demandOf(double separation, double impulse, bool is_stiff, const SolveSettings& settings, bool with_push) const;
    double separationOf(const SoftPoint& p, const RigidBody& on_a, const RigidBody& on_b) const;
    Point reachOf(const Point& arm_a, const RigidBody& on_a, const RigidBody& on_b) const; // from A to the point of B
    double speedAt(const SoftPoint& p, const RigidBody& on_a, const RigidBody& on_b) const;
    void weighPressing(const RigidBody& on_a, const RigidBody& on_b);
    void weighRubbing(const RigidBody& on_a, const RigidBody& on_b);
    void solveTogether(RigidBody& on_a, RigidBody& on_b, const std::array<Demand, kPoints>& demands);
    void solvePoint(SoftPoint& p, RigidBody& on_a, RigidBody& on_b, const Demand& demand) const;
    void resistTwist(RigidBody& on_a, RigidBody& on_b, double most);
    void resistSliding(RigidBody& on_a, RigidBody& on_b, double most);

    Point center_a = {0, 0, 0}, center_b = {0, 0, 0};
    bool follows = false;   // A's arms do B's points; where one does not move, arms stay
    Point slid = {0, 0, 0}; // B's center from A's when the step began
    double reach = 0;       // mean distance of the points from their center
    double twist_mass = 0;
    Point rub_mass = {0, 0, 0};      // along and across the tangent: 11, 12, 22
    std::array<Four, kPoints> press; // impulses at all points by the speeds that they are to give
};

} // namespace reference
