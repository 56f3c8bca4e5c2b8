// Sites that stay: placed, and the first at their place. Equal ones are welded and counted.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, welded);
READS(2, uint, placed);
WRITES(3, uint, flags);

void main() {
    uint s = flatIndex();
    if (s >= counts[COUNT_ASKED_SITES] || counts[STATUS_FAILED] != 0u) return;
    bool here = placed[s] != 0u, first = welded[s] == s;
    if (!here) atomicAdd(counts[STATUS_UNPLACED], 1u);
    if (here && !first) atomicAdd(counts[STATUS_WELDED], 1u);
    flags[s] = here && first ? 1u : 0u;
}
