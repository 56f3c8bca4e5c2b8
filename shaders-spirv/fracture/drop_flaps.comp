// Takes flaps out of the surface: what their two sides faced, faces each other from then on. A dropped triangle keeps, in
// place of its parent, the other side of its flap.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, suspects);
READS(2, uint, partners);
UPDATES(3, uvec4, pieces);
UPDATES(4, uint, sources);
WRITES(5, uint, parents);
#include "lib/flap_key.glsl"

void main() {
    uint k = flatIndex();
    if (k >= 2u * counts[COUNT_SUSPECTS] || counts[STATUS_FAILED] != 0u || partners[k] == NO_INDEX) return;
    uint t = suspectTriangle(k);
    parents[t] = partners[k];
    pieces[t].w = NO_INDEX;
    sources[t] |= FLAP_BIT;
}
