// Both sides of every cap: the lower cell's, and its mirror image for the other, always in a row. Lists those that may be
// one side of a flap: only corners that fell together, or lie in one line, can make two caps of a cell coincide.
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

// Corners in one line, as those on a Voronoi edge: two faces that meet there may have the same sliver.
bool isThin(uvec3 t) {
    vec3 u = unit * (positions[t.y].xyz - positions[t.x].xyz), w = unit * (positions[t.z].xyz - positions[t.x].xyz), v = w - u;
    float longest = max(dot(u, u), max(dot(v, v), dot(w, w)));
    return length(cross(u, w)) <= 4.0 * step_size * sqrt(longest);
}

void main() {
    uint at = flatIndex();
    if (at >= counts[COUNT_FACES] || counts[STATUS_FAILED] != 0u) return;
    uint f = faces[at], from = cap_slots[at], slots = from + 2u * (face_offsets[f + 1u] - face_offsets[f]);
    uint to = counts[COUNT_MESH_TRIANGLES] + counts[COUNT_FAN_TRIANGLES] + 2u * cap_offsets[at];
    uint left = cap_offsets[at + 1u] - cap_offsets[at];
    for (; left > 0u && from < slots; from++) {
        uvec3 cap = uvec3(loose_caps[3u * from], loose_caps[3u * from + 1u], loose_caps[3u * from + 2u]);
        if (cap.x != NO_INDEX) {
            bool flat_ = cap.x == cap.y || cap.y == cap.z || cap.z == cap.x;
            pieces[to] = uvec4(cap, flat_ ? NO_INDEX : face_cells[f]);
            pieces[to + 1u] = uvec4(cap.xzy, flat_ ? NO_INDEX : neighbors[f]);
            sources[to] = INNER_BIT | f;
            sources[to + 1u] = INNER_BIT | f;
            parents[to] = to;
            parents[to + 1u] = to + 1u;
            bool suspect = !flat_ && ((shared_points[cap.x] | shared_points[cap.y] | shared_points[cap.z]) != 0u || isThin(cap));
            if (suspect) suspects[atomicAdd(counts[COUNT_SUSPECTS], 1u)] = to;
            to += 2u;
            left--;
        }
    }
}
