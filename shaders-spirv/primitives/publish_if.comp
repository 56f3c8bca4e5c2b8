// Publishes one count under another name where a third is not 0, and 0 otherwise: so that kernels idle.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(local_size_x = 1) in;
UPDATES(0, uint, counts);
WRITES(1, uint, args);
layout(push_constant) uniform Push {
    uint count;
    uint source;
    uint condition;
};
#include "lib/publish.glsl"

void main() { publishCount(count, counts[condition] != 0u ? counts[source] : 0u, NO_INDEX); }
