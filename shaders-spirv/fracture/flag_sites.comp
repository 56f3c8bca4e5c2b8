// Sites that stay: placed, and the first at their place. Equal ones are welded and counted.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, welded);
READS(2, uint, placed);
WRITES(3, uint, flags);
layout(push_constant) uniform Push { uint site_count; };

void main() {
    uint s = flatIndex();
    if (s >= site_count) return;
    bool here = placed[s] != 0u, first = welded[s] == s;
    if (!here) atomicAdd(counts[STATUS_UNPLACED], 1u);
    if (here && !first) atomicAdd(counts[STATUS_WELDED], 1u);
    flags[s] = here && first ? 1u : 0u;
}
