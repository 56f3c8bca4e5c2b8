// Caps of a convex surface, a workgroup a face: there every corner sees the whole cap, and nothing is looked at. On any other
// surface triangles come out turned over, which the check of the fragments finds.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

GROUP_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, faces);
READS(2, uint, face_offsets);
READS(3, uvec4, segments);
READS(4, uint, welded);
READS(5, uint, shared_points);
WRITES(6, uint, loose_caps);
WRITES(7, uint, cap_counts);
READS(8, uint, wide_faces);
WRITES(9, uint, cap_slots);
#include "lib/vast_face.glsl"
WRITES(10, VastFace, vast_faces);
#include "lib/vast_list.glsl"
#include "lib/fan.glsl"

shared uint doubtful;

// Sides can only have an opposite where a face of the mesh lies in the bisector, or corners have fallen together.
void findCorner(uint lane) {
    for (uint k = lane; k < n; k += GROUP_SIZE) {
        uvec4 s = segments[first + k];
        uint a = welded[s.x], b = welded[s.y];
        if (a != b) atomicMax(greatest, a);
        if ((s.w | shared_points[a] | shared_points[b]) != 0u) atomicOr(doubtful, 1u);
    }
    barrier();
}

// Of the sides between two corners so many are left as there are more this way than the other: the first ones.
bool isLeft(uvec4 s, uint a, uint b) {
    uint along = 0u, against = 0u, earlier = 0u, others = doubtful != 0u ? n : 0u;
    for (uint k = 0u; k < others; k++) {
        uvec4 other = segments[first + k];
        uint from = welded[other.x], to = welded[other.y];
        bool same = from == a && to == b;
        along += same ? 1u : 0u;
        earlier += same && other.z < s.z ? 1u : 0u;
        against += from == b && to == a ? 1u : 0u;
    }
    return others == 0u || earlier + against < along;
}

void saveFan(uint lane) {
    for (uint k = lane; k < n; k += GROUP_SIZE) {
        uvec4 s = segments[first + k];
        uint a = welded[s.x], b = welded[s.y];
        bool side = a != b && a != greatest && b != greatest && isLeft(s, a, b);
        saveTriangle(first + rankOf(s.z), side, greatest, a, b);
    }
    barrier();
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    bool idle = counts[STATUS_FAILED] != 0u || flatGroup() >= counts[COUNT_WIDE_FACES];
    uint index = idle ? 0u : wide_faces[flatGroup()], f = idle ? 0u : faces[index];
    first = face_offsets[f];
    uint size = idle ? 0u : face_offsets[f + 1u] - first;
    n = size <= HUGE_FACE ? size : 0u;
    if (lane == 0u) {
        greatest = 0u;
        made = 0u;
        doubtful = 0u;
    }
    loadSources(lane);
    barrier();
    findCorner(lane);
    saveFan(lane);
    if (lane == 0u && !idle) {
        cap_counts[index] = made;
        cap_slots[index] = first;
        if (size > HUGE_FACE) listVast(index, size);
    }
}
