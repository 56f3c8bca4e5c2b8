// Long lists of pairs, such as those of the ground, a workgroup a list: every second piece sets its bit, and the bits are read off
// in order. The cost is that of the list and a word for every 32 pieces that there are.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/broad_phase.h"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, uint, pair_offsets);
READS(2, uvec2, loose_pairs);
READS(3, uint, long_lists);
WRITES(4, uvec2, pairs);
#define PER_LANE (BITMAP_WORDS / GROUP_SIZE)

shared uint bitmap[BITMAP_WORDS];
shared uint sums[GROUP_SIZE];

void setBits(uint lane, uint first, uint end, uint window) {
    for (uint k = 0u; k < ROLLED(PER_LANE); k++) bitmap[k * GROUP_SIZE + lane] = 0u;
    barrier();
    for (uint k = first + lane; k < end; k += GROUP_SIZE) {
        uint bit = loose_pairs[k].y - window;
        if (bit < 32u * BITMAP_WORDS) atomicOr(bitmap[bit >> 5], 1u << (bit & 31u));
    }
    barrier();
}

// Bits of the lanes up to and with this one; each has a run of words.
uint countBits(uint lane) {
    uint own = 0u;
    for (uint k = 0u; k < ROLLED(PER_LANE); k++) own += bitCount(bitmap[lane * PER_LANE + k]);
    sums[lane] = own;
    barrier();
    for (uint step = 1u; step < ROLLED(GROUP_SIZE); step <<= 1) {
        uint left = lane >= step ? sums[lane - step] : 0u;
        barrier();
        sums[lane] += left;
        barrier();
    }
    return own;
}

void writeBits(uint lane, uint a, uint at, uint window) {
    for (uint k = 0u; k < ROLLED(PER_LANE); k++) {
        uint word = lane * PER_LANE + k, bits = bitmap[word];
        for (uint turn = 0u; turn < 32u && bits != 0u; turn++) {
            pairs[at] = uvec2(a, window + 32u * word + findLSB(bits));
            bits &= bits - 1u;
            at++;
        }
    }
}

void main() {
    uint list = flatGroup(), lane = gl_LocalInvocationID.x;
    if (list >= counts[COUNT_LONG_LISTS]) return;
    uint a = long_lists[list], first = pair_offsets[a], end = pair_offsets[a + 1u], n = counts[COUNT_TREE_BOXES], at = first;
    for (uint window = 0u; window < n; window += 32u * BITMAP_WORDS) {
        setBits(lane, first, end, window);
        uint own = countBits(lane);
        writeBits(lane, a, at + sums[lane] - own, window);
        at += sums[GROUP_SIZE - 1u];
        barrier();
    }
}
