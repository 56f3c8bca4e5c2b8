// The order in which a body touches hulls. First comes the hull that it lies deepest in, then the one that it meets first on its straight
// way, then the one that it is nearest to.
//
// Ways of one body, or of two bodies against each other, are as long as they take. So the earliest hit has the shortest way.
//
// Wants `bodies` declared.
#ifndef FIRST_HIT_GLSL
#define FIRST_HIT_GLSL
#include "lib/ordered_float.glsl"
#include "lib/rounded_alike.glsl"

const float kBehindHits = 1e24; // more than any way squared, per meter of a gap

bool touches(AxisRecord record) { return record.info.x != AXIS_APART && (record.info.x & AXIS_LEVEL) == 0u; }

// The lower, the earlier. Two kernels have to find the same bits.
uint orderOfHit(AxisRecord record) {
    precise float way = alikeDot(record.shift.xyz, record.shift.xyz), gap = record.axis.w;
    float order = way > 0.0 ? way : gap > 0.0 ? kBehindHits * gap : gap;
    return orderedBits(vec3(order)).x;
}

bool moves(uint body) { return bodies[body].offset.w > 0.0; }

#endif
