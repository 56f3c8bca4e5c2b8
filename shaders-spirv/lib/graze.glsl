// Seams. Hulls that overlap by a thin strip only, along the normal of a face, graze each other there: so a body lies on a floor
// of several hulls. Any other axis is one along which it would run into the side of the next of them, which its neighbor hides. So
// where the hulls come closer along the axis that was found, and there are faces that they graze, that face counts to which
// they come closer most slowly.
//
// Source: the rules of active edges and voided features (Terdiman, MeshContacts; Jolt's ActiveEdges.h), without adjacency.
//
// Wants lib/axis_kernel.glsl.
#ifndef GRAZE_GLSL
#define GRAZE_GLSL
#include "lib/strip.glsl"

float strip;     // how wide it may be between these two; 0 where nothing falls
uint floor_side; // 1: A, 2: B, 0: neither

// A floor leads: what slides on it would be turned aside by its own face, which tilts with each seam. Of two that move a body that is
// clearly heavier, or a hull that is clearly larger, is the floor.
const float kHeavier = 4.0, kLarger = 1.25; // times the mass, the radius

uint floorOf() {
    float light_a = bodies[pair.ids.z].offset.w, light_b = bodies[pair.ids.w].offset.w; // 1 / kg, 0 of what does not move
    if (light_a > kHeavier * light_b) return 2u;
    if (light_b > kHeavier * light_a) return 1u;
    float radius_a = pair.hull[0].center.w, radius_b = pair.hull[1].center.w;
    return radius_b > kLarger * radius_a ? 2u : radius_a > kLarger * radius_b ? 1u : 0u;
}

// Before all else here, once the hulls are loaded.
void findFloor() {
    strip = stripBetween(push.strip, pair.smaller);
    floor_side = floorOf();
}

const float kAllButParallel = 0.98; // cosine

// By how much an axis has to be better than one of a face, which leads.
float leadOver(vec3 leading, vec3 axis) {
    bool is_same = floor_side != 0u && dot(leading, axis) > kAllButParallel;
    return is_same ? max(0.25 * strip, tie) : tie;
}

float closingTo(vec3 axis) { return -dot(axis, pair.drift); }

// `axis`: as found; `steps`: until the hulls meet along it. What is seen as the separation is how slowly they come closer. That
// they may fall meanwhile does not count: what lies on a floor does not.
Seen seeGrazed(bool of_a, vec3 axis, float steps, bool wanted) {
    uint count = wanted ? (of_a ? face_counts.x : face_counts.y) : 0u;
    float slower = closingTo(axis) - 0.25 * strip;
    Seen seen = seenNothing();
    for (uint base = 0u; base < count; base += LANES) {
        uint f = min(base + lane, count - 1u);
        FaceAlong along = alongFace(of_a, f);
        float closes = closingTo(along.axis);
        bool grazes = along.separation - steps * max(closes, 0.0) > -strip;
        if (grazes && closes < slower) see(seen, -closes, 0.0, 0.0, featureOf(of_a, f));
    }
    return seenByAll(seen);
}

// The face that counts instead of the axis; NO_INDEX for none.
uint grazedFace(vec3 axis, float steps, bool wanted) {
    bool comes_closer = wanted && pair.planes == 0u && floor_side != 0u && strip > 0.0 && closingTo(axis) > 0.25 * strip;
    Seen best = seenNothing();
    for (uint side = 0u; side < ROLLED(2); side++) {
        Seen seen = seeGrazed(side == 0u, axis, steps, comes_closer);
        bool is_better = isBetter(seen.separation, seen.feature, best.separation, best.feature);
        if (is_better) best = seen;
    }
    return best.feature;
}

#endif
