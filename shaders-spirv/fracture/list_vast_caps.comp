// Lists both sides of the caps of vast faces, a lane a half-edge.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

#include "lib/vast_face.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, faces);
READS(2, uint, neighbors);
READS(3, uint, face_cells);
READS(4, VastFace, vast_faces);
READS(5, uint, cap_offsets);
READS(6, uint, vast_caps);
WRITES(7, uvec4, pieces);
WRITES(8, uint, sources);
WRITES(9, uint, parents);
READS(10, uint, shared_points);
WRITES(11, uint, suspects);
READS(12, vec4, positions);
READS(13, uint, vast_offsets);
READS(14, uvec4, vast_ends);
layout(push_constant) uniform Push {
    float unit;      // model units to box units
    float step_size; // of the grid, in box units
};
#include "lib/cap_sides.glsl"

void main() {
    uint h = flatIndex();
    if (h >= counts[COUNT_VAST_HALVES] || counts[STATUS_FAILED] != 0u) return;
    if (vast_offsets[h + 1u] == vast_offsets[h]) return;
    VastFace face = vast_faces[vast_ends[h / VAST_HALVES].w];
    uint rank = vast_offsets[h] - vast_offsets[VAST_HALVES * face.first];
    uint first = counts[COUNT_MESH_TRIANGLES] + counts[COUNT_FAN_TRIANGLES] + 2u * cap_offsets[face.index];
    saveBothSides(first + 2u * rank, uvec3(vast_caps[3u * h], vast_caps[3u * h + 1u], vast_caps[3u * h + 2u]), faces[face.index]);
}
