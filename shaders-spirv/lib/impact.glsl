// How hard a contact was hit in a step: by what its points came in with, and over all of those that were pressed. Wants
// `solver_contacts`, `solver_bodies` and `memory`, as it was when the step began, declared.
#include "lib/solver_body.glsl"

struct Impact {
    uint points;
    float mass, speed, impulse;
    vec3 arm_a, arm_b; // of the middle of these points, when the step began
};

// Each of them alone; what lies there is pressed as well, but comes in with no speed. What was braked in the last substep of the step
// before, so that it comes to lie in this one's first, has been told of then.
bool isHit(SolverPoint p, float carried, float least_speed) {
    return p.pulse.y > 0.0 && p.pulse.z < -least_speed && carried != HIT_LAST;
}

Impact impactOf(uint c, float least_speed) {
    uvec4 ids = solver_contacts[c].ids;
    vec3 normal = solver_contacts[c].normal.xyz;
    Impact impact = Impact(0u, 0.0, 0.0, 0.0, vec3(0.0), vec3(0.0));
    for (uint k = 0u; k < MANIFOLD_POINTS && k < ids.z; k++) {
        SolverPoint p = solver_contacts[c].points[k];
        if (!isHit(p, memory[ids.w].arm_b[k].w, least_speed)) continue;
        impact.points++;
        impact.speed -= p.pulse.z;
        impact.arm_a += p.arm_a.xyz;
        impact.arm_b += p.arm_b.xyz;
    }
    if (impact.points == 0u) return impact;
    float share = 1.0 / float(impact.points);
    impact.speed *= share;
    impact.arm_a *= share;
    impact.arm_b *= share;
    Moving a = movingOf(solver_bodies[ids.x]), b = movingOf(solver_bodies[ids.y]);
    float yield_ = yieldAlong(a, impact.arm_a, normal, normal) + yieldAlong(b, impact.arm_b, normal, normal);
    impact.mass = yield_ > 0.0 ? 1.0 / yield_ : 0.0;
    float leaves = dot(normal, velocityAt(b, impact.arm_b) - velocityAt(a, impact.arm_a));
    // What still comes in by the end of the step was braked in its last substep, and comes to lie in the next one's first.
    impact.impulse = impact.mass * (impact.speed + max(leaves, 0.0));
    return impact;
}

float energyOf(Impact impact) { return 0.5 * impact.mass * impact.speed * impact.speed; }
