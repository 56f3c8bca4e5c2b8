// Adds one to every element, in place.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/dispatch.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) buffer Words { uint words[]; };

void main() {
    uint i = flatIndex();
    if (i < uint(words.length())) words[i] += 1u;
}
