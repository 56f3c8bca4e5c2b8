// The same over predefined axes (the paper, section 6): directions of the world, a workgroup a pair. The faces that are laid over
// each other are those that look most squarely along the best one.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/axis_kernel.glsl"
#include "shared/collider.h"
#include "lib/support_directions.glsl"

vec3 fixedAxis(uint direction) { return turned(turnBack(pair.turn), normalize(vec3(supportDirection(direction)))); }

float separationAlong(vec3 n) {
    float low_b = lowestCorner(uvec2(pair.hull[1].first.x, corner_counts.y), pair.hull[1].center.xyz, n * pair.axes[1]);
    float low_a = lowestCorner(uvec2(pair.hull[0].first.x, corner_counts.x), pair.hull[0].center.xyz, -n);
    return low_b + dot(n, pair.place[1]) + low_a;
}

Seen seeFixedAxes(uint count) {
    Seen seen = seenNothing();
    for (uint base = 0u; base < count; base += LANES) {
        uint direction = min(base + lane, count - 1u);
        vec3 n = fixedAxis(direction);
        see(seen, separationAlong(n), dot(n, pair.motion), 0.0, (AXIS_FIXED << AXIS_KIND_SHIFT) | direction);
    }
    return seenByAll(seen);
}

AxisRecord foundBy(Seen seen) {
    bool is_hit = isHit(seen);
    uint feature = is_hit ? seen.enter_feature : seen.feature;
    vec3 axis = fixedAxis(feature & 0xffu);
    vec4 heights = measureAlong(axis);
    Seen a = facingFace(true, axis, heights.y), b = facingFace(false, axis, -heights.z);
    bool b_leads = b.separation > a.separation + kTie;
    return recordOf(feature, axis, heights, is_hit ? seen.enter * pair.motion : vec3(0.0), b_leads,
                    b_leads ? uvec2(b.feature, a.feature) : uvec2(a.feature, b.feature));
}

void main() {
    uint k = flatGroup();
    if (k >= min(counts[push.count_at], push.capacity) || isKnown(k)) return;
    loadHulls(k);
    Seen seen = seeFixedAxes(min(push.fixed_axes, uint(SUPPORT_DIRECTIONS)));
    AxisRecord record = apartBy(seen.separation);
    if (!isApart(seen)) record = foundBy(seen);
    if (isMiss(seen, record.axis.xyz)) record = apartBy(seen.separation);
    if (lane == 0u) keepRecord(k, record);
}
