// Bodies while they are solved: what an impulse does to them. Wants `solver_bodies` declared.
#ifndef SOLVER_BODY_GLSL
#define SOLVER_BODY_GLSL
#include "lib/quaternion.glsl"
#include "shared/solver.h"

struct Moving {
    vec3 velocity, spin;
    vec3 diagonal, side; // of the inverse inertia: xx, yy, zz; xy, xz, yz
    float inverse_mass;
};

Moving movingOf(SolverBody b) {
    return Moving(b.velocity.xyz, b.spin.xyz, vec3(b.inertia.x, b.inertia.w, b.spin.w), vec3(b.inertia.yz, b.moved.w), b.velocity.w);
}

vec3 spinBy(Moving m, vec3 twist) {
    return m.diagonal * twist + vec3(m.side.x * twist.y + m.side.y * twist.z, m.side.x * twist.x + m.side.z * twist.z,
                                     m.side.y * twist.x + m.side.z * twist.y);
}

void push(inout Moving m, vec3 impulse, vec3 twist) {
    m.velocity += m.inverse_mass * impulse;
    m.spin += spinBy(m, twist);
}

// How far the other body has got since the step began, for one whose arms follow it. `arms`: ARMS_*.
vec3 followed(SolverBody a, SolverBody b, float arms, bool of_b) {
    vec3 apart = b.moved.xyz - a.moved.xyz;
    return arms != float(of_b ? ARMS_OF_B_FOLLOW : ARMS_OF_A_FOLLOW) ? vec3(0.0) : (of_b ? -apart : apart);
}

vec3 shifted(vec4 turn, vec3 arm) { return turned(turn, arm) - arm; }

// By how much the turning of bodies has moved the arms of a point since the step began. Both bodies are met at one point: that of the
// body which the other's arms follow.
vec3 shiftOfArm(vec3 arm_a, vec3 arm_b, vec4 turned_a, vec4 turned_b, float arms, bool of_b) {
    bool by_b = of_b ? arms != float(ARMS_OF_B_FOLLOW) : arms == float(ARMS_OF_A_FOLLOW);
    return by_b ? shifted(turned_b, arm_b) : shifted(turned_a, arm_a);
}

// Arm of a point as it is now. `slid`: how far it has followed the other body.
vec3 armNow(vec3 arm_a, vec3 arm_b, vec3 slid, vec4 turned_a, vec4 turned_b, float arms, bool has_turned, bool of_b) {
    vec3 arm = (of_b ? arm_b : arm_a) + slid;
    return has_turned ? arm + shiftOfArm(arm_a, arm_b, turned_a, turned_b, arms, of_b) : arm;
}

vec3 velocityAt(Moving m, vec3 arm) { return m.velocity + cross(m.spin, arm); }

// How much speed along v an impulse along u at the arm gives.
float yieldAlong(Moving m, vec3 arm, vec3 u, vec3 v) {
    return m.inverse_mass * dot(u, v) + dot(cross(arm, v), spinBy(m, cross(arm, u)));
}

#endif
