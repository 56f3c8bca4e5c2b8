// Groups the polygons by triangle; the order inside a group is made by order_polygons.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec2, pairs);
READS(2, uvec2, pair_shape);
READS(3, uint, polygon_offsets); // by mixed triangle
UPDATES(4, uint, cursors);
WRITES(5, uint, loose_polygons);

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_PAIRS] || counts[STATUS_FAILED] != 0u) return;
    uint m = pairs[p].x;
    if (pair_shape[p].x == 0u) return;
    loose_polygons[polygon_offsets[m] + atomicAdd(cursors[m], 1u)] = p;
}
