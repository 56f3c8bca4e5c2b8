// What is known of a contact of two bodies that turn, with both standing as they will when they meet. Wants `manifolds`, and what
// lib/flight.glsl and lib/who_breaks.glsl want, declared.
#include "lib/blow_place.glsl"
#include "lib/component.glsl"
#include "lib/flight.glsl"
#include "lib/who_breaks.glsl"
#include "shared/breaking.h"
#include "shared/contact.h"

struct TurningContact {
    Flight a, b;
    vec3 arm_a, arm_b; // of the place where they meet, world axes
    float separation;
    float closing; // m/s, there
    float soonest; // s since the step began, of all points that come closer: when the first of them meets
};

bool movesOf(uint body) { return solver_bodies[body].velocity.w > 0.0; }

float closingAt(TurningContact c, uint k, vec3 arm_a, vec3 arm_b) {
    return -dot(manifolds[k].normal.xyz, velocityAt(c.b, arm_b) - velocityAt(c.a, arm_a));
}

float yieldOf(uint body, Flight f, vec3 arm, vec3 normal) {
    if (!movesOf(body)) return 0.0;
    return solver_bodies[body].velocity.w + turningYield(worldInertia(ownInverseInertia(shapes[body]), f.turn), arm, normal);
}

// 0 where neither moves.
float yieldOf(TurningContact c, TurningBlow t, vec3 normal) {
    return yieldOf(t.ids.y, c.a, c.arm_a, normal) + yieldOf(t.ids.z, c.b, c.arm_b, normal);
}

bool breaksAny(TurningContact c, TurningBlow t, vec3 normal) {
    float yield_ = yieldOf(c, t, normal);
    return yield_ > 0.0 && sidesThatBreak(t.ids.yz, blowAt(yield_, c.closing, 0.0, c.arm_a, c.arm_b, normal)) != 0u;
}

// Of a layer of the points.
void meetAt(vec4 weights, uint k, TurningBlow t, inout TurningContact c) {
    c.arm_a = c.arm_b = vec3(0.0);
    for (uint i = 0u; i < MANIFOLD_POINTS && i < manifolds[k].info.x; i++) {
        c.arm_a += weights[i] * manifolds[k].points[i].arm_a.xyz;
        c.arm_b += weights[i] * manifolds[k].points[i].arm_b.xyz;
    }
    roundArms(t.ids.yz, manifolds[k].normal.xyz, c.arm_a, c.arm_b);
    c.closing = closingAt(c, k, c.arm_a, c.arm_b);
}

// With points there.
TurningContact contactOf(uint k, TurningBlow t) {
    TurningContact next;
    next.a = flightOf(t.ids.y, movesOf(t.ids.y), t.time.x);
    next.b = flightOf(t.ids.z, movesOf(t.ids.z), t.time.x);
    vec4 separations = vec4(0.0), closings = vec4(kNoPoint);
    for (uint i = 0u; i < MANIFOLD_POINTS && i < manifolds[k].info.x; i++) {
        ContactPoint point = manifolds[k].points[i];
        separations = withComponent(separations, i, point.arm_a.w);
        closings = withComponent(closings, i, closingAt(next, k, point.arm_a.xyz, point.arm_b.xyz));
    }
    TurningContact c;
    float soonest = 3e38, limit = kNoLimit;
    for (uint layer = 0u; layer < kLayers && isLayer(layer, closings, limit); layer++) {
        meetAt(weightsOf(separations, closings, limit, next.separation), k, t, next);
        if (layer == 0u) c = next;
        if (next.closing <= 0.0) break;
        soonest = min(soonest, t.time.x + next.separation / next.closing);
        if (isSooner(next.separation, next.closing, c.separation, c.closing) && breaksAny(next, t, manifolds[k].normal.xyz)) c = next;
    }
    c.soonest = soonest;
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
