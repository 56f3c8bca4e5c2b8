// Words in the order of a list: out[k] = words[list[k]].
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, words);
READS(2, uint, list);
WRITES(3, uint, gathered);
layout(push_constant) uniform Push { uint length_count; };

void main() {
    uint k = flatIndex();
    if (k < counts[length_count]) gathered[k] = words[list[k]];
}
