// Takes flaps out of the surface: what their two sides faced, faces each other from then on. A dropped triangle keeps, in
// place of its parent, the other side of its flap.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, suspects);
READS(2, uint, flap_table);
READS(3, uint, flap_slots);
UPDATES(4, uvec4, pieces);
UPDATES(5, uint, sources);
WRITES(6, uint, parents);
#include "lib/flap_key.glsl"

void main() {
    uint k = flatIndex();
    if (k >= 2u * counts[COUNT_SUSPECTS] || counts[STATUS_FAILED] != 0u) return;
    uint slot = flap_slots[k], t = suspectTriangle(k);
    bool flap = slot != NO_INDEX && flap_table[4u * slot + 2u] == 1u && flap_table[4u * slot + 3u] == 1u;
    if (!flap) return;
    parents[t] = (flap_table[4u * slot] - 1u) ^ (flap_table[4u * slot + 1u] - 1u) ^ t;
    pieces[t].w = NO_INDEX;
    sources[t] |= FLAP_BIT;
}
