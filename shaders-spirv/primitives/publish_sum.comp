// Publishes a count that is a weighted sum of others.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(local_size_x = 1) in;
UPDATES(0, uint, counts);
WRITES(1, uint, args);
layout(push_constant) uniform Push {
    uint count;
    uint capacity;
    uint pad0;
    uint pad1;
    uvec4 terms; // counts, or NO_INDEX
    uvec4 weights;
};
#include "lib/publish.glsl"

void main() {
    uint total = 0u;
    for (uint k = 0u; k < 4u; k++) total += terms[k] == NO_INDEX ? 0u : counts[terms[k]] * weights[k];
    publishCount(count, total, capacity);
}
