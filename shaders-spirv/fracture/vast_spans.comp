// A segment tree over the ranks of corners (Bentley 1977): a side is listed at the fewest nodes that make up the ranks between
// its ends, so that each side at the height of a corner stands once on the way from the corner's leaf to the root. Runs twice, to
// count and to fill.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(constant_id = 0) const uint kFill = 0u;
FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec4, vast_ends);
READS(2, uvec4, vast_rings);
UPDATES(3, uint, span_counts); // while filling: cursors
READS(4, uint, span_offsets);
WRITES(5, uint, vast_spans);
layout(push_constant) uniform Push { uint leaves; };

void listAt(uint node, uint side) {
    uint at = atomicAdd(span_counts[node], 1u);
    if (kFill != 0u) vast_spans[span_offsets[node] + at] = side;
}

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_VAST_SIDES] || counts[STATUS_FAILED] != 0u) return;
    if (vast_ends[k].z == 0u) return;
    uint a = vast_rings[k].z, b = vast_rings[vast_rings[k].x].z;
    uint from = leaves + min(a, b) + 1u, to = leaves + max(a, b); // half-open
    for (uint level = 0u; level < 32u && from < to; level++) {
        if ((from & 1u) != 0u) listAt(from++, k);
        if ((to & 1u) != 0u) listAt(--to, k);
        from >>= 1;
        to >>= 1;
    }
}
