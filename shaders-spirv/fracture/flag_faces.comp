// Bisectors that carry a cap at all.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, face_offsets);
WRITES(2, uint, flags);

void main() {
    uint f = flatIndex();
    if (f >= counts[COUNT_NEIGHBORS] || counts[STATUS_FAILED] != 0u) return;
    flags[f] = face_offsets[f + 1u] != face_offsets[f] ? 1u : 0u;
}
