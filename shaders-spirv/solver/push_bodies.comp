// A substep begins: gravity, and the impulses of the substep before once more (warm starting), each body's in the order of its
// contacts.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/solver_body.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, SolverContact, solver_contacts);
READS(2, uint, adjacency_start);
READS(3, uint, adjacency); // a contact << 1, | 1 where the body is its B
UPDATES(4, SolverBody, solver_bodies);
layout(push_constant) uniform Push { SolverPush push_; };
#include "lib/blow.glsl"

vec3 impulseOf(uint c, bool is_b, out vec3 twist) {
    uint points = solver_contacts[c].ids.z;
    vec3 normal = solver_contacts[c].normal.xyz, tangent = solver_contacts[c].tangent.xyz, across = cross(normal, tangent);
    vec4 rub = isBlow(c, points) ? vec4(0.0) : solver_contacts[c].rub;
    vec3 slide = rub.x * tangent + rub.y * across, sum = slide;
    twist = cross(is_b ? solver_contacts[c].center_b.xyz : solver_contacts[c].center_a.xyz, slide) + rub.z * normal;
    for (uint k = 0u; k < MANIFOLD_POINTS && k < points; k++) {
        vec4 pulse = solver_contacts[c].points[k].pulse;
        vec3 pressed = (pulse.w != 0.0 ? 0.0 : pulse.x) * normal;
        sum += pressed;
        twist += cross(is_b ? solver_contacts[c].points[k].arm_b.xyz : solver_contacts[c].points[k].arm_a.xyz, pressed);
    }
    return sum;
}

void main() {
    uint b = flatIndex();
    if (b >= push_.bodies || counts[STATUS_FAILED] != 0u) return;
    Moving m = movingOf(solver_bodies[b]);
    if (m.inverse_mass == 0.0) return;
    vec3 impulse = vec3(0.0), twist = vec3(0.0);
    for (uint k = adjacency_start[b]; k < adjacency_start[b + 1u]; k++) {
        bool is_b = (adjacency[k] & 1u) != 0u;
        vec3 turning;
        vec3 one = impulseOf(adjacency[k] >> 1, is_b, turning);
        impulse += is_b ? one : -one;
        twist += is_b ? turning : -turning;
    }
    m.velocity += push_.gravity.w * push_.gravity.xyz;
    push(m, impulse, twist);
    solver_bodies[b].velocity.xyz = m.velocity;
    solver_bodies[b].spin.xyz = m.spin;
}
