// First half of an exclusive prefix sum: one sum for every block of SCAN_BLOCK values.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/scan_value.glsl"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, Value, values);
WRITES(2, Value, sums);
layout(push_constant) uniform Push {
    uint length;       // number of values, where the host knows it
    uint length_count; // else the count that holds it, or NO_INDEX
};

shared Value partial[GROUP_SIZE];

void main() {
    uint n = length_count == NO_INDEX ? length : counts[length_count];
    uint lane = gl_LocalInvocationID.x;
    uint first = flatGroup() * SCAN_BLOCK + lane * (SCAN_BLOCK / GROUP_SIZE);
    Value sum = Value(0);
    for (uint k = 0u; k < ROLLED(SCAN_BLOCK / GROUP_SIZE); k++) {
        sum += first + k < n ? values[min(first + k, n - 1u)] : Value(0);
    }
    partial[lane] = sum;
    barrier();
    for (uint width = ROLLED(GROUP_SIZE / 2u); width > 0u; width >>= 1) {
        if (lane < width) partial[lane] += partial[lane + width];
        barrier();
    }
    if (lane == 0u) sums[flatGroup()] = partial[0];
}
