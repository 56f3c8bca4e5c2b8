// Components that are parts of another's fragment: cavities.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec2, fates);
WRITES(2, uint, flags);

void main() {
    uint c = flatIndex();
    if (c >= counts[COUNT_COMPONENTS] || counts[STATUS_FAILED] != 0u) return;
    flags[c] = fates[c].x == FATE_CAVITY ? 1u : 0u;
}
