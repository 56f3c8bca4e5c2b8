// Stable radix sort of all keys by one workgroup, which needs no other kernel between two digits: every lane holds a run of
// consecutive keys and counts its digits, a prefix sum over (digit, lane) says where each goes. Only the order moves, keys stay.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/broad_phase.h"

layout(local_size_x = GROUP_SORT_LANES) in;
READS(0, uint, counts);
READS(1, uint, key_low);
READS(2, uint, key_high);
// Twice as long as there is room for boxes: the halves take turns. Lanes read what others have written.
layout(set = 0, binding = 3, std430) coherent buffer order_block { uint order[]; };
layout(push_constant) uniform Push { uint box_capacity; };
#define DIGITS (1u << GROUP_SORT_BITS)

shared uint tally[DIGITS * GROUP_SORT_LANES];
shared uint row_sums[GROUP_SORT_LANES];

struct Digit {
    uint shift;
    bool high;
};

uint digitOf(uint piece, Digit digit) {
    uint word = digit.high ? key_high[piece] : key_low[piece];
    return (word >> digit.shift) & (DIGITS - 1u);
}

// Sums of all that stands before, in place.
void addUp(uint lane) {
    uint first = lane * DIGITS, sum = 0u;
    for (uint k = 0u; k < ROLLED(DIGITS); k++) sum += tally[first + k];
    row_sums[lane] = sum;
    barrier();
    for (uint step = 1u; step < ROLLED(GROUP_SORT_LANES); step <<= 1) {
        uint left = lane >= step ? row_sums[lane - step] : 0u;
        barrier();
        row_sums[lane] += left;
        barrier();
    }
    uint running = row_sums[lane] - sum;
    for (uint k = 0u; k < ROLLED(DIGITS); k++) {
        uint here = tally[first + k];
        tally[first + k] = running;
        running += here;
    }
    barrier();
}

void sortBy(Digit digit, uint n, uint from, uint to) {
    uint lane = gl_LocalInvocationID.x, run = (n + GROUP_SORT_LANES - 1u) / GROUP_SORT_LANES;
    uint first = lane * run, end = min(first + run, n);
    for (uint d = 0u; d < ROLLED(DIGITS); d++) tally[d * GROUP_SORT_LANES + lane] = 0u;
    for (uint k = first; k < end; k++) tally[digitOf(order[from + k], digit) * GROUP_SORT_LANES + lane]++;
    barrier();
    addUp(lane);
    for (uint k = first; k < end; k++) {
        uint piece = order[from + k];
        uint slot = digitOf(piece, digit) * GROUP_SORT_LANES + lane;
        uint at = tally[slot];
        tally[slot] = at + 1u;
        order[to + at] = piece;
    }
    memoryBarrierBuffer();
    barrier();
}

void main() {
    uint n = counts[COUNT_TREE_BOXES], from = 0u;
    for (uint part = 0u; part < ROLLED(2); part++) {
        uint bits = part == 0u ? KEY_LOW_BITS : KEY_HIGH_BITS;
        for (uint shift = 0u; shift < bits; shift += GROUP_SORT_BITS) {
            sortBy(Digit(shift, part == 1u), n, from, box_capacity - from);
            from = box_capacity - from;
        }
    }
}
