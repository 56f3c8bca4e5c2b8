// A body on its own, some time after the step has begun or before: how it stands, and how it moves. Wants `bodies`, `shapes`,
// `solver_bodies` and `gravity`, whose w is the length of a substep, declared.
#include "lib/rigid.glsl"

struct Flight {
    vec4 turn;
    vec3 way; // of the center of mass since the step began
    vec3 velocity, spin;
};

// Speeds are brought up to the time of the place that they belong to (lib/approach.glsl).
Flight flightOf(uint body, bool moves, float time) {
    BodyState b = bodies[body];
    if (!moves) return Flight(b.turn, vec3(0.0), vec3(0.0), vec3(0.0));
    mat3 own = ownInverseInertia(shapes[body]);
    vec4 turn = turnFreely(vec3(own[0][0], own[1][1], own[2][2]), b.turn, b.momentum.xyz, time);
    vec3 fall = (b.sector.w & BODY_BORNE) == 0 ? gravity.xyz : vec3(0.0), start = solver_bodies[body].velocity.xyz + 0.5 * gravity.w * fall;
    return Flight(turn, time * (start + 0.5 * time * fall), start + time * fall, spinOf(own, turn, b.momentum.xyz));
}

vec3 velocityAt(Flight f, vec3 arm) { return f.velocity + cross(f.spin, arm); }
