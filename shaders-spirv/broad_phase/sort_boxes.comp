// Stable radix sort of all keys by one workgroup, which needs no other kernel between two digits. Only the order moves, keys stay.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/broad_phase.h"

#define LANES GROUP_SORT_LANES
#define DIGIT_BITS GROUP_SORT_BITS
layout(local_size_x = LANES) in;
READS(0, uint, counts);
READS(1, uint, key_low);
READS(2, uint, key_high);
// Twice as long as there is room for boxes: the halves take turns. Lanes read what others have written.
layout(set = 0, binding = 3, std430) coherent buffer order_block { uint order[]; };
layout(push_constant) uniform Push { uint box_capacity; };

// From 32 on, of the high word.
uint digitOf(uint piece, uint shift) {
    uint word = shift >= 32u ? key_high[piece] : key_low[piece];
    return (word >> (shift & 31u)) & ((1u << DIGIT_BITS) - 1u);
}
#include "lib/group_sort.glsl"

void main() {
    uint n = counts[COUNT_TREE_BOXES], from = 0u;
    for (uint part = 0u; part < ROLLED(2); part++) {
        uint bits = part == 0u ? KEY_LOW_BITS : KEY_HIGH_BITS;
        for (uint shift = 0u; shift < bits; shift += DIGIT_BITS) {
            sortBy(32u * part + shift, n, from, box_capacity - from);
            from = box_capacity - from;
        }
    }
}
