// Gathers caps of one cell with the same corners: how many face which way, the lowest and the highest of them.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, suspects);
READS(2, uvec4, pieces);
UPDATES(3, uint, flap_table); // four words a slot: lowest + 1, highest + 1, facing up, facing down
WRITES(4, uint, flap_slots);
layout(push_constant) uniform Push { uint table_mask; };
#include "lib/flap_key.glsl"

void main() {
    uint k = flatIndex();
    if (k >= 2u * counts[COUNT_SUSPECTS] || counts[STATUS_FAILED] != 0u) return;
    uint t = suspectTriangle(k), slot = NO_INDEX;
    uvec4 key = flapKey(t);
    uint hash = flapHash(key);
    for (uint probe = 0u; probe < 1024u && slot == NO_INDEX; probe++) {
        uint at = (hash + probe) & table_mask;
        uint held = atomicCompSwap(flap_table[4u * at], 0u, t + 1u);
        if (held == 0u || flapKey(held - 1u) == key) slot = at;
    }
    if (slot == NO_INDEX) {
        atomicAdd(counts[STATUS_BAD_UNION], 1u);
    } else {
        atomicMin(flap_table[4u * slot], t + 1u);
        atomicMax(flap_table[4u * slot + 1u], t + 1u);
        atomicAdd(flap_table[4u * slot + (turnsUp(t) ? 2u : 3u)], 1u);
    }
    flap_slots[k] = slot;
}
