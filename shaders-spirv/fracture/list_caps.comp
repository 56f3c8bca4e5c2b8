// Lists both sides of every cap, but for those of vast faces.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, faces);
READS(2, uint, neighbors);
READS(3, uint, face_cells);
READS(4, uint, face_offsets);
READS(5, uint, cap_offsets);
READS(6, uint, loose_caps);
WRITES(7, uvec4, pieces);
WRITES(8, uint, sources);
WRITES(9, uint, parents);
READS(10, uint, shared_points);
WRITES(11, uint, suspects);
READS(12, vec4, positions);
READS(13, uint, cap_slots);
layout(push_constant) uniform Push {
    float unit;      // model units to box units
    float step_size; // of the grid, in box units
};

#include "lib/cap_sides.glsl"

void main() {
    uint at = flatIndex();
    if (at >= counts[COUNT_FACES] || counts[STATUS_FAILED] != 0u) return;
    uint f = faces[at], from = cap_slots[at], slots = from + 2u * (face_offsets[f + 1u] - face_offsets[f]);
    uint to = counts[COUNT_MESH_TRIANGLES] + counts[COUNT_FAN_TRIANGLES] + 2u * cap_offsets[at];
    bool vast = face_offsets[f + 1u] - face_offsets[f] > HUGE_FACE; // list_vast_caps lists its caps
    uint left = vast ? 0u : cap_offsets[at + 1u] - cap_offsets[at];
    for (; left > 0u && from < slots; from++) {
        uvec3 cap = uvec3(loose_caps[3u * from], loose_caps[3u * from + 1u], loose_caps[3u * from + 2u]);
        if (cap.x != NO_INDEX) {
            saveBothSides(to, cap, f);
            to += 2u;
            left--;
        }
    }
}
