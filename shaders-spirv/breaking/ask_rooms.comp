// What each fragment needs of the world's pools, and where those of each object begin, in the order of objects.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/breaking.h"
#include "shared/collider.h"
#include "shared/fragment_record.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, owners); // sorted
READS(2, uint, order);
READS(3, FragmentRecord, fragments);
READS(4, ColliderRecord, colliders);
WRITES(5, uvec4, sizes);
WRITES(6, uint, owner_start);

#include "lib/face_room.glsl"

// Of loops, each edge has two sides.
uint facesFor(ColliderRecord hull) { return faceRoom(uvec4(hull.range.w, hull.range.y, hull.info.y, hull.info.y / 2u)); }

// An object that came out in one piece stays what it is.
bool isAlone(uint r, uint fragments_) {
    bool first = r == 0u || owners[r - 1u] != owners[r], last = r + 1u == fragments_ || owners[r + 1u] != owners[r];
    return first && last;
}

void main() {
    uint r = flatIndex(), fragments_ = counts[COUNT_FRAGMENTS];
    if (r >= fragments_) return;
    uint f = order[r];
    uvec4 wanted = uvec4(1u, 1u, facesFor(colliders[f]), fragments[f].range.z + fragments[f].range.w);
    sizes[r] = isAlone(r, fragments_) ? uvec4(0u) : wanted;
    // All objects from the one before to this fragment's begin here, those without fragments too.
    uint own = owners[r], last = r > 0u ? owners[r - 1u] + 1u : 0u;
    for (uint k = last; k <= own && k < MOST_BREAKING; k++) owner_start[k] = r;
    if (r + 1u < fragments_) return;
    for (uint k = own + 1u; k <= counts[COUNT_BREAKING] && k <= MOST_BREAKING; k++) owner_start[k] = fragments_;
}
