// Lists of the sides that lie at one edge, in no order. Each begins at the first of its sides.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec2, sides);
READS(2, uint, first_sides);
UPDATES(3, uint, heads); // side + 1; 0: no side
WRITES(4, uint, links);  // to the next side, as in heads
WRITES(5, uint, wedges);

void main() {
    uint s = flatIndex();
    if (s >= counts[COUNT_MESH_CORNERS] || counts[STATUS_FAILED] != 0u) return;
    wedges[s] = NO_INDEX;
    if (sides[s].y == NO_INDEX) return;
    links[s] = atomicExchange(heads[first_sides[s]], s + 1u);
}
