// Lists the sides of vast faces with the names of the corners where they begin, which they are sorted by.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

#include "lib/vast_face.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, faces);
READS(2, uint, face_offsets);
READS(3, uvec4, segments);
READS(4, uint, welded);
READS(5, VastFace, vast_faces);
WRITES(6, uvec4, listed); // names of both corners, source, face
WRITES(7, uint, keys);
WRITES(8, uint, values);

uint faceOf(uint lane) {
    uint found = 0u, faces_ = counts[COUNT_VAST_FACES];
    for (uint j = 0u; j < faces_; j++) {
        bool holds = lane >= vast_faces[j].first && lane - vast_faces[j].first < vast_faces[j].count;
        found = holds ? j : found;
    }
    return found;
}

void main() {
    uint lane = flatIndex();
    if (lane >= counts[COUNT_VAST_SIDES] || counts[STATUS_FAILED] != 0u) return;
    uint j = faceOf(lane);
    VastFace face = vast_faces[j];
    uvec4 s = segments[face_offsets[faces[face.index]] + lane - face.first];
    uint a = welded[s.x];
    listed[lane] = uvec4(a, welded[s.y], s.z, j);
    keys[lane] = a;
    values[lane] = lane;
}
