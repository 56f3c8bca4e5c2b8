// A substep begins for a body: gravity, and the impulses of the substep before once more (warm starting), in the order of its
// contacts. Wants `solver_contacts`, `solver_bodies`, `adjacency_start`, `adjacency` and lib/effect.glsl's friction declared.
#include "lib/blow.glsl"
#include "lib/has_turned.glsl"
#include "lib/solver_body.glsl"

vec3 impulseOf(uint c, bool is_b, out vec3 twist) {
    uvec4 ids = solver_contacts[c].ids;
    vec3 normal = solver_contacts[c].normal.xyz, tangent = solver_contacts[c].tangent.xyz, across = cross(normal, tangent);
    vec4 kept = kFriction != 0u ? solver_contacts[c].rub : vec4(0.0), rub = isBlow(c, ids.z) ? vec4(0.0) : kept;
    vec3 slide = rub.x * tangent + rub.y * across, sum = slide;
    SolverBody a = solver_bodies[ids.x], b = solver_bodies[ids.y];
    float arms = solver_contacts[c].rub_mass.w;
    vec3 slid = followed(a, b, arms, is_b);
    bool has_turned = hasTurned(c, ids.z, a, b);
    vec3 center_a = solver_contacts[c].center_a.xyz, center_b = solver_contacts[c].center_b.xyz;
    twist = cross(armNow(center_a, center_b, slid, a.turned, b.turned, arms, has_turned, is_b), slide) + rub.z * normal;
    for (uint k = 0u; k < MANIFOLD_POINTS && k < ids.z; k++) {
        vec4 pulse = solver_contacts[c].points[k].pulse;
        vec3 pressed = (pulse.w >= POINT_HIT ? 0.0 : pulse.x) * normal;
        sum += pressed;
        vec3 arm_a = solver_contacts[c].points[k].arm_a.xyz, arm_b = solver_contacts[c].points[k].arm_b.xyz;
        twist += cross(armNow(arm_a, arm_b, slid, a.turned, b.turned, arms, has_turned, is_b), pressed);
    }
    return sum;
}

// `falls`: what gravity adds to its speed.
void pushBody(uint b, vec3 falls) {
    Moving m = movingOf(solver_bodies[b]);
    vec3 impulse = vec3(0.0), twist = vec3(0.0);
    uint first = kContacts != 0u ? adjacency_start[b] : 0u, last = kContacts != 0u ? adjacency_start[b + 1u] : 0u;
    for (uint k = first; k < last; k++) {
        uint entry = adjacency[k];
        bool is_b = (entry & 1u) != 0u;
        vec3 turning;
        vec3 one = impulseOf(entry >> 1, is_b, turning);
        impulse += is_b ? one : -one;
        twist += is_b ? turning : -turning;
    }
    m.velocity += falls;
    push(m, impulse, twist);
    solver_bodies[b].velocity.xyz = m.velocity;
    solver_bodies[b].spin.xyz = m.spin;
}
