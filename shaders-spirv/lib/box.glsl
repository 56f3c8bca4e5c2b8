// Boxes as two uvec4: the low corner and the body, the high corner and the flags. Corners are floats in bits, so that what stands
// in w is never taken for a number.
#include "shared/broad_phase.h"

const float kFar = 1e37; // centers beyond lie at the origin: their box is found all the same, only later

struct Box {
    uvec4 low, high;
};

// From plus to minus infinity: nothing meets it, and joined with another box it changes nothing.
const Box kNoBox = Box(uvec4(uvec3(0x7f800000u), NO_BODY), uvec4(uvec3(0xff800000u), BOX_ABSENT));
const float kGreatest = 3.4028234e38;

vec3 lowOf(Box box) { return uintBitsToFloat(box.low.xyz); }
vec3 highOf(Box box) { return uintBitsToFloat(box.high.xyz); }

// A box that is inside out or holds what is no number stands for no box; one without bounds ends at the greatest numbers, so that
// not even it meets kNoBox.
Box checkedBox(uvec4 low, uvec4 high) {
    vec3 least = uintBitsToFloat(low.xyz), most = uintBitsToFloat(high.xyz);
    bool ordered = all(lessThanEqual(least, most));
    if (!ordered || (high.w & BOX_ABSENT) != 0u) return kNoBox;
    low.xyz = floatBitsToUint(max(least, vec3(-kGreatest)));
    high.xyz = floatBitsToUint(min(most, vec3(kGreatest)));
    return Box(low, high);
}

bool isAbsent(Box box) { return (box.high.w & BOX_ABSENT) != 0u; }
bool isStatic(Box box) { return (box.high.w & BOX_STATIC) != 0u; }

// Touching counts.
bool meet(Box a, Box b) { return all(lessThanEqual(lowOf(a), highOf(b))) && all(lessThanEqual(lowOf(b), highOf(a))); }

vec3 centerOf(Box box) {
    vec3 center = 0.5 * lowOf(box) + 0.5 * highOf(box);
    return mix(vec3(0), center, lessThanEqual(abs(center), vec3(kFar)));
}

// The exponent of the longest edge, as it stands in a float.
uint sizeOf(Box box) {
    vec3 edges = highOf(box) - lowOf(box);
    return floatBitsToUint(max(edges.x, max(edges.y, edges.z))) >> 23;
}
