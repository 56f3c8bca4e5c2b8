// The lowest half-edge of each part of a vast face, by pointer jumping: each round doubles how far a half-edge has looked.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(constant_id = 0) const uint kFirst = 0u;
FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec2, vast_halves);
READS(2, uvec2, from); // lowest that has been seen, and where to look next
WRITES(3, uvec2, to);

void main() {
    uint h = flatIndex();
    if (h >= counts[COUNT_VAST_HALVES] || counts[STATUS_FAILED] != 0u) return;
    uint next = vast_halves[h].x;
    if (next == NO_INDEX) return;
    if (kFirst != 0u) {
        to[h] = uvec2(h, next);
        return;
    }
    uvec2 mine = from[h], far = from[mine.y];
    to[h] = uvec2(min(mine.x, far.x), far.y);
}
