// Publishes counts that other kernels built up with atomics. `first` of a round is where the last one ended.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(local_size_x = 1) in;
UPDATES(0, uint, counts);
WRITES(1, uint, args);
layout(push_constant) uniform Push {
    uint count;
    uint capacity;
};
#include "lib/publish.glsl"

void main() { publishCount(count, counts[count], capacity); }
