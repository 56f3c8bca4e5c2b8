// What is known of a contact of two bodies that turn, with both standing as they will when they meet. Wants `manifolds`, and what
// lib/flight.glsl wants, declared.
#include "lib/flight.glsl"
#include "shared/breaking.h"
#include "shared/contact.h"

struct TurningContact {
    Flight a, b;
    vec3 arm_a, arm_b;       // of the point that meets first, world axes
    vec3 middle_a, middle_b; // of all points
    float separation;
    float closing; // m/s, at that point
};

bool movesOf(uint body) { return solver_bodies[body].velocity.w > 0.0; }

// With points there.
TurningContact contactOf(uint k, TurningBlow t) {
    TurningContact c;
    c.a = flightOf(t.ids.y, movesOf(t.ids.y), t.arm_a.w);
    c.b = flightOf(t.ids.z, movesOf(t.ids.z), t.arm_a.w);
    c.middle_a = c.middle_b = c.arm_a = c.arm_b = vec3(0.0);
    c.separation = 3e38;
    uint points = min(manifolds[k].info.x, MANIFOLD_POINTS);
    for (uint i = 0u; i < points; i++) {
        vec4 arm_a = manifolds[k].points[i].arm_a, arm_b = manifolds[k].points[i].arm_b;
        c.middle_a += arm_a.xyz / float(points);
        c.middle_b += arm_b.xyz / float(points);
        if (arm_a.w >= c.separation) continue;
        c.separation = arm_a.w;
        c.arm_a = arm_a.xyz;
        c.arm_b = arm_b.xyz;
    }
    c.closing = -dot(manifolds[k].normal.xyz, velocityAt(c.b, c.arm_b) - velocityAt(c.a, c.arm_a));
    return c;
}
