// How much of the pools every component needs: fragments with their parts, the rest nothing.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, component_start);
READS(2, uvec4, class_offsets);
READS(3, uvec2, fates);
WRITES(4, uvec4, demands);  // fragment, triangles
WRITES(5, uvec4, shares);   // two each: triangles of every class before this component's in its fragment; of the whole fragment
READS(6, uint, parts);       // by owner
READS(7, uint, part_owners);
#define SORTED part_owners
#define SORTED_COUNT COUNT_PARTS
#include "lib/sorted_list.glsl"

uvec3 sizeOf(uint c) { return class_offsets[component_start[c + 1u]].xyz - class_offsets[component_start[c]].xyz; }

void main() {
    uint c = flatIndex();
    if (c >= counts[COUNT_COMPONENTS] || counts[STATUS_FAILED] != 0u) return;
    uvec2 fate = fates[c];
    bool part = fate.x == FATE_CAVITY;
    uvec3 total = sizeOf(fate.y), before = part ? total : uvec3(0u);
    uint first = firstFrom(fate.y), last = firstFrom(fate.y + 1u);
    if (last - first > MOST_TURNS) atomicOr(counts[STATUS_BAD_UNION], 1u);
    last = min(last, first + MOST_TURNS);
    for (uint k = first; k < last; k++) {
        uvec3 size = sizeOf(parts[k]);
        total += size;
        before += part && parts[k] < c ? size : uvec3(0u);
    }
    uint size = total.x + total.y + total.z;
    demands[c] = fate.x == FATE_FRAGMENT && size > 0u ? uvec4(1u, size, 0u, 0u) : uvec4(0u);
    shares[2u * c] = uvec4(before, 0u);
    shares[2u * c + 1u] = uvec4(total, 0u);
}
