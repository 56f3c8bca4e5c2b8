// Pairs whose points are to be found, packed.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/broad_phase.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec2, pairs);
READS(2, uint, fresh_slots);
WRITES(3, uvec2, fresh_pairs);

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_BOX_PAIRS]) return;
    uint slot = fresh_slots[p];
    if (fresh_slots[p + 1u] != slot) fresh_pairs[slot] = pairs[p];
}
