// Opposite sides of vast faces cancel: where more run one way than the other, as many are left as there are more. Those are
// listed at the corners where they end.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

#include "lib/vast_face.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, VastFace, vast_faces);
UPDATES(2, uvec4, vast_ends); // names of both corners, whether the side is left, face
WRITES(3, uvec4, vast_rings); // next side, previous side, rank by height
UPDATES(4, uint, vast_heads); // of lists, at the first side that begins at a corner
WRITES(5, uint, vast_links);
#include "lib/vast_corners.glsl"

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_VAST_SIDES] || counts[STATUS_FAILED] != 0u) return;
    uvec4 mine = vast_ends[k];
    uint along = 0u, against = 0u, earlier = 0u;
    uint s = firstSideAt(mine.w, mine.x), end = endOfSidesAt(s, mine.w, mine.x);
    for (; s < end; s++) {
        bool same = vast_ends[s].y == mine.y;
        along += same ? 1u : 0u;
        earlier += same && s < k ? 1u : 0u;
    }
    uint there = firstSideAt(mine.w, mine.y);
    end = endOfSidesAt(there, mine.w, mine.y);
    for (s = there; s < end; s++) against += vast_ends[s].y == mine.x ? 1u : 0u;
    bool is_left = mine.x != mine.y && along > against && earlier < along - against;
    vast_ends[k].z = is_left ? 1u : 0u;
    vast_rings[k] = uvec4(NO_INDEX, NO_INDEX, 0u, 0u);
    if (is_left && beginsAt(there, mine.w, mine.y)) vast_links[k] = atomicExchange(vast_heads[there], k);
}
