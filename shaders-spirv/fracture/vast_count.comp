// How many triangles the cap of a vast face has. It is no bad cap any more.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

#include "lib/vast_face.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, VastFace, vast_faces);
READS(2, uint, vast_offsets);
WRITES(3, uint, cap_counts);

void main() {
    uint j = flatIndex();
    if (j >= counts[COUNT_VAST_FACES] || counts[STATUS_FAILED] != 0u) return;
    VastFace face = vast_faces[j];
    cap_counts[face.index] = vast_offsets[VAST_HALVES * (face.first + face.count)] - vast_offsets[VAST_HALVES * face.first];
    atomicAdd(counts[STATUS_BAD_CAP], NO_INDEX);
}
