// Ranks of the corners of vast faces by height. An outline that does not close, because signs were rounded, fails the event.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uvec4, vast_ends);
UPDATES(2, uvec4, vast_rings);
READS(3, uint, vast_order); // corners by face and height
WRITES(4, uint, vast_heads); // of lists of diagonals from now on

void main() {
    uint rank = flatIndex();
    if (rank >= counts[COUNT_VAST_SIDES] || counts[STATUS_FAILED] != 0u) return;
    uint k = vast_order[rank];
    vast_heads[k] = NO_INDEX;
    vast_rings[k].z = rank;
    bool is_open = vast_rings[k].x == NO_INDEX || vast_rings[k].y == NO_INDEX;
    if (vast_ends[k].z != 0u && is_open) {
        atomicAdd(counts[STATUS_OPEN_OUTLINES], 1u);
        atomicOr(counts[STATUS_FAILED], FAILED_CLIP);
    }
}
