// Stable radix sort, one digit: how often each digit occurs in each tile, digit by digit for the scan.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, uint, keys);
WRITES(2, uint, histogram);
layout(push_constant) uniform Push {
    uint length_count;
    uint shift;
};
#define DIGITS (1u << RADIX_BITS)
#define PER_LANE (RADIX_TILE / GROUP_SIZE)

shared uint tally[DIGITS * GROUP_SIZE];

void main() {
    uint n = counts[length_count], lane = gl_LocalInvocationID.x, tile = flatGroup();
    uint tiles = (n + RADIX_TILE - 1u) / RADIX_TILE;
    for (uint d = 0u; d < ROLLED(DIGITS); d++) tally[d * GROUP_SIZE + lane] = 0u;
    uint first = tile * RADIX_TILE + lane * PER_LANE;
    for (uint k = first; k < min(first + PER_LANE, n); k++) tally[((keys[k] >> shift) & (DIGITS - 1u)) * GROUP_SIZE + lane]++;
    barrier();
    if (lane < DIGITS) {
        uint sum = 0u;
        for (uint k = 0u; k < ROLLED(GROUP_SIZE); k++) sum += tally[lane * GROUP_SIZE + k];
        histogram[lane * tiles + tile] = sum;
    }
}
