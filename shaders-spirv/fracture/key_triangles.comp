// Sorting keys: the component of every triangle that stays. Components count in the order of their lowest triangles.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec4, flag_offsets);
UPDATES(2, uint, parents);
WRITES(3, uint, keys);
WRITES(4, uint, values);
WRITES(5, uint, components); // by triangle
#include "lib/union_find.glsl"

void main() {
    uint t = flatIndex();
    if (t >= counts[COUNT_TRIANGLES] || counts[STATUS_FAILED] != 0u) return;
    uint at = flag_offsets[t].x;
    bool valid = flag_offsets[t + 1u].x != at;
    components[t] = NO_INDEX;
    if (valid) { // of a dropped flap, `parents` says its other side: following that would write it over
        uint component = flag_offsets[rootOf(t)].y;
        components[t] = component;
        keys[at] = component;
        values[at] = t;
    }
}
