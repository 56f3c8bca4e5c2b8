// Adds the flat index of the lane, times a factor, and a bias to every element.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/dispatch.glsl"

#ifndef TIMES
#define TIMES 1
#endif

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kBias = 0;
layout(set = 0, binding = 0, std430) readonly buffer Source { uint source[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Target { uint target[]; };
layout(push_constant) uniform Push {
    uint count;
    uint factor;
};

void main() {
    uint i = flatIndex();
    if (i >= count) return;
    target[i] = TIMES * (source[i] + i * factor + kBias);
}
