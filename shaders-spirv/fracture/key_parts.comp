// Sorting keys: whom each part belongs to. The sort is stable, so that the parts of one fragment stay in their own order.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, parts);
READS(2, uvec2, fates);
WRITES(3, uint, part_owners);

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_PARTS] || counts[STATUS_FAILED] != 0u) return;
    part_owners[k] = fates[parts[k]].y;
}
