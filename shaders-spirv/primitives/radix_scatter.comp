// Stable radix sort, one digit: every key goes behind the smaller digits, the same digit of earlier tiles, and the same
// digit of earlier lanes, each of which holds a run of consecutive keys.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, uint, keys);
READS(2, uint, values);
READS(3, uint, digit_offsets);
WRITES(4, uint, sorted_keys);
WRITES(5, uint, sorted_values);
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
    uint first = tile * RADIX_TILE + lane * PER_LANE, last = min(first + PER_LANE, n);
    for (uint k = first; k < last; k++) tally[((keys[k] >> shift) & (DIGITS - 1u)) * GROUP_SIZE + lane]++;
    barrier();
    if (lane < DIGITS) {
        uint running = digit_offsets[lane * tiles + tile];
        for (uint k = 0u; k < ROLLED(GROUP_SIZE); k++) {
            uint here = tally[lane * GROUP_SIZE + k];
            tally[lane * GROUP_SIZE + k] = running;
            running += here;
        }
    }
    barrier();
    for (uint k = first; k < last; k++) {
        uint key = keys[k];
        uint slot = ((key >> shift) & (DIGITS - 1u)) * GROUP_SIZE + lane;
        uint to = tally[slot];
        tally[slot] = to + 1u;
        sorted_keys[to] = key;
        sorted_values[to] = values[k];
    }
}
