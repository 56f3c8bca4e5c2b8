// What is known of a contact of two bodies that turn, with both standing as they will when they meet. Wants `manifolds`, and what
// lib/flight.glsl wants, declared.
#include "lib/blow_place.glsl"
#include "lib/component.glsl"
#include "lib/flight.glsl"
#include "shared/breaking.h"
#include "shared/contact.h"

struct TurningContact {
    Flight a, b;
    vec3 arm_a, arm_b; // of the place where they meet, world axes
    float separation;
    float closing; // m/s, there
};

bool movesOf(uint body) { return solver_bodies[body].velocity.w > 0.0; }

float closingAt(TurningContact c, uint k, vec3 arm_a, vec3 arm_b) {
    return -dot(manifolds[k].normal.xyz, velocityAt(c.b, arm_b) - velocityAt(c.a, arm_a));
}

// With points there.
TurningContact contactOf(uint k, TurningBlow t) {
    TurningContact c;
    c.a = flightOf(t.ids.y, movesOf(t.ids.y), t.time.x);
    c.b = flightOf(t.ids.z, movesOf(t.ids.z), t.time.x);
    uint points = min(manifolds[k].info.x, MANIFOLD_POINTS);
    vec4 separations = vec4(0.0), closings = vec4(kNoPoint);
    for (uint i = 0u; i < points; i++) {
        ContactPoint point = manifolds[k].points[i];
        separations = withComponent(separations, i, point.arm_a.w);
        closings = withComponent(closings, i, closingAt(c, k, point.arm_a.xyz, point.arm_b.xyz));
    }
    vec4 weights = weightsOf(separations, closings, c.separation);
    c.arm_a = c.arm_b = vec3(0.0);
    for (uint i = 0u; i < points; i++) {
        c.arm_a += weights[i] * manifolds[k].points[i].arm_a.xyz;
        c.arm_b += weights[i] * manifolds[k].points[i].arm_b.xyz;
    }
    roundArms(t.ids.yz, manifolds[k].normal.xyz, c.arm_a, c.arm_b);
    c.closing = closingAt(c, k, c.arm_a, c.arm_b);
    return c;
}

// In each other, after a time at which they are known to have been apart.
bool isWithin(TurningContact c, TurningBlow t) { return c.separation < 0.0 && t.time.z > 0.0; }

// By Newton's method, and from within by the chord: deep in each other bodies are parted along another axis than that along which they
// came, and may even be on their way out.
float meetingTime(TurningContact c, TurningBlow t) {
    if (isWithin(c, t)) return mix(t.time.y, t.time.x, t.time.z / (t.time.z - c.separation));
    return t.time.x + c.separation / c.closing;
}
