// Sets a buffer to 0, where something is to be done with it: so many workgroups share it.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

GROUP_KERNEL;
WRITES(0, uvec4, words);
layout(push_constant) uniform Push { uint length; }; // in fours

void main() {
    uint lanes = gl_NumWorkGroups.x * GROUP_SIZE;
    for (uint k = flatIndex(); k < length; k += lanes) words[k] = uvec4(0u);
}
