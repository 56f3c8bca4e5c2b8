// How much of the pools every component needs: fragments with their cavities, the rest nothing.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, component_start);
READS(2, uvec4, class_offsets);
READS(3, uvec2, fates);
WRITES(4, uvec4, demands);  // fragment, triangles
WRITES(5, uvec4, shares);   // outer and inner triangles before this component's in its fragment; of the whole fragment

uvec2 sizeOf(uint c) { return class_offsets[component_start[c + 1u]].xy - class_offsets[component_start[c]].xy; }

void main() {
    uint c = flatIndex();
    if (c >= counts[COUNT_COMPONENTS] || counts[STATUS_FAILED] != 0u) return;
    uvec2 fate = fates[c], total = sizeOf(fate.y), before = fate.y != c ? total : uvec2(0u);
    uint others = counts[STATUS_CAVITIES] != 0u ? counts[COUNT_COMPONENTS] : 0u;
    for (uint o = 0u; o < others; o++) {
        if (o != fate.y && fates[o] == uvec2(FATE_CAVITY, fate.y)) {
            uvec2 size = sizeOf(o);
            total += size;
            before += fate.y != c && o < c ? size : uvec2(0u);
        }
    }
    bool fragment = fate.x == FATE_FRAGMENT && total.x + total.y > 0u;
    demands[c] = fragment ? uvec4(1u, total.x + total.y, 0u, 0u) : uvec4(0u);
    shares[c] = uvec4(before, total);
}
