// Lists of the sides that lie at one edge, in no order. Each begins at the first of its sides. All of them bound one wedge until
// pair_wedges finds out more.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec2, sides);
READS(2, uint, first_sides);
UPDATES(3, uint, heads); // side + 1; 0: no side
WRITES(4, uint, links);  // to the next side, as in heads
WRITES(5, uint, wedges); // the first side of the edge; NO_INDEX of triangles without area

void main() {
    uint s = flatIndex();
    if (s >= counts[COUNT_MESH_CORNERS] || counts[STATUS_FAILED] != 0u) return;
    bool is_flat = sides[s].y == NO_INDEX;
    wedges[s] = is_flat ? NO_INDEX : first_sides[s];
    if (is_flat) return;
    links[s] = atomicExchange(heads[first_sides[s]], s + 1u);
}
