// Moves the finished colliders into their pools, a workgroup a piece.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/collider.h"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, uint, loose_colliders);
READS(2, uvec4, collider_offsets);
READS(3, uvec2, fragment_list);
WRITES(4, ColliderRecord, collider_records);
WRITES(5, ColliderFaceRecord, collider_faces);
WRITES(6, vec4, collider_vertices);
WRITES(7, uint, collider_corners); // vertices, counted from the piece's own first

float numberAt(uint at) { return uintBitsToFloat(loose_colliders[at]); }

ColliderFaceRecord faceAt(uint base, uint k, uint faces, uint corners) {
    uint at = base + 4u + COLLIDER_FACE_WORDS * k, start = loose_colliders[at + 4u], id = loose_colliders[at + 5u];
    uint end = k + 1u < faces ? loose_colliders[at + COLLIDER_FACE_WORDS + 4u] : corners;
    vec4 plane = vec4(numberAt(at), numberAt(at + 1u), numberAt(at + 2u), numberAt(at + 3u));
    bool of_cell = id < BOX_BASE;
    return ColliderFaceRecord(plane, uvec4(start, end - start, of_cell ? id : NO_INDEX, of_cell ? FACE_OF_CELL : id - BOX_BASE));
}

void main() {
    uint f = flatGroup(), lane = gl_LocalInvocationID.x;
    if (f >= counts[COUNT_FRAGMENTS] || counts[STATUS_FAILED] != 0u) return;
    uint base = f * COLLIDER_WORDS;
    uvec4 head = uvec4(loose_colliders[base], loose_colliders[base + 1u], loose_colliders[base + 2u], loose_colliders[base + 3u]);
    uvec3 to = collider_offsets[f].xyz;
    for (uint k = lane; k < head.x; k += GROUP_SIZE) {
        ColliderFaceRecord face = faceAt(base, k, head.x, head.z);
        face.loop.x += to.z;
        collider_faces[to.x + k] = face;
    }
    for (uint k = lane; k < head.y; k += GROUP_SIZE) {
        uint at = base + COLLIDER_VERTICES_AT + 3u * k;
        collider_vertices[to.y + k] = vec4(numberAt(at), numberAt(at + 1u), numberAt(at + 2u), 0.0);
    }
    for (uint k = lane; k < head.z; k += GROUP_SIZE) collider_corners[to.z + k] = loose_colliders[base + COLLIDER_LOOPS_AT + k];
    if (lane == 0u)
        collider_records[f] = ColliderRecord(uvec4(to.x, head.x, to.y, head.y), uvec4(to.z, head.z, fragment_list[f].y, head.w));
}
