// An event on what breaks in a step begins: how many bins its sites go into, and whether anything is to be done at all. Kernels of
// one workgroup and the clearing of tables hang on that, all others on counts that follow.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(local_size_x = 1) in;
UPDATES(0, uint, counts);
WRITES(1, uint, args);
layout(push_constant) uniform Push { uint bins; }; // of an object
#include "lib/publish.glsl"

void main() {
    uint breaking = counts[COUNT_BREAKING];
    publishCount(COUNT_BINS, bins * breaking, NO_INDEX);
    publishCount(COUNT_EVENT, min(breaking, 1u), NO_INDEX);
    publishCount(COUNT_CLEARING, breaking > 0u ? CLEARING_GROUPS : 0u, NO_INDEX);
}
