// What each fragment needs of the world's pools; nothing where its object stays whole after all, or where it is too small to be a
// body.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/smallest_piece.glsl"
#include "shared/breaking.h"
#include "shared/collider.h"
#include "shared/fragment_record.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, owners); // sorted
READS(2, uint, order);
READS(3, FragmentRecord, fragments);
READS(4, ColliderRecord, colliders);
READS(5, float, cracks);
WRITES(6, uvec4, sizes);
READS(7, BreakingRecord, breaking);
layout(push_constant) uniform Push { float least_volume; }; // m3, of a body

#include "lib/face_room.glsl"

// Of loops, each edge has two sides.
uint facesFor(ColliderRecord hull) { return faceRoom(uvec4(hull.range.w, hull.range.y, hull.info.y, hull.info.y / 2u)); }

void main() {
    uint r = flatIndex();
    if (r >= counts[COUNT_FRAGMENTS]) return;
    uint f = order[r];
    uvec4 wanted = uvec4(1u, 1u, facesFor(colliders[f]), fragments[f].range.z + fragments[f].range.w);
    bool is_body = !isTooSmall(fragments[f].measure.x, breaking[owners[r]].center.w, least_volume);
    sizes[r] = is_body && cracks[owners[r]] > 0.0 ? wanted : uvec4(0u);
}
