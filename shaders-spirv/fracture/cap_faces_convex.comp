// Caps of a convex surface that have few corners, a face a lane: the fan from the corner with the greatest name, as in
// cap_fans_convex, to which the rest goes.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

#define SMALL SMALL_FACE
FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, faces);
READS(2, uint, face_offsets);
READS(3, uvec4, segments);
READS(4, uint, welded);
WRITES(5, uint, loose_caps);
WRITES(6, uint, cap_counts);
WRITES(7, uint, wide_faces);
WRITES(8, uint, cap_slots);

uvec3 sides[SMALL]; // from, to, source

// Its place among the sides, and whether it is left when opposite ones have taken each other away.
uvec2 rankAndLeft(uvec3 side, uint n) {
    uint rank = 0u, along = 0u, against = 0u, earlier = 0u;
    for (uint k = 0u; k < n; k++) {
        uvec3 other = sides[k];
        bool lower = other.z < side.z, same = other.xy == side.xy;
        rank += lower ? 1u : 0u;
        along += same ? 1u : 0u;
        earlier += same && lower ? 1u : 0u;
        against += other.yx == side.xy ? 1u : 0u;
    }
    return uvec2(rank, side.x != side.y && earlier + against < along ? 1u : 0u);
}

void main() {
    uint at = flatIndex();
    if (at >= counts[COUNT_FACES] || counts[STATUS_FAILED] != 0u) return;
    uint f = faces[at], first = face_offsets[f], size = face_offsets[f + 1u] - first;
    if (size > SMALL) wide_faces[atomicAdd(counts[COUNT_WIDE_FACES], 1u)] = at;
    uint n = size <= SMALL ? size : 0u, corner = 0u, made = 0u;
    for (uint k = 0u; k < n; k++) {
        uvec4 s = segments[first + k];
        sides[k] = uvec3(welded[s.x], welded[s.y], s.z);
        corner = sides[k].x != sides[k].y ? max(corner, sides[k].x) : corner;
    }
    for (uint k = 0u; k < n; k++) {
        uvec3 side = sides[k];
        uvec2 found = rankAndLeft(side, n);
        bool counted = found.y != 0u && side.x != corner && side.y != corner;
        uint slot = 3u * (first + found.x);
        loose_caps[slot] = counted ? corner : NO_INDEX;
        loose_caps[slot + 1u] = side.x;
        loose_caps[slot + 2u] = side.y;
        made += counted ? 1u : 0u;
    }
    cap_counts[at] = made;
    cap_slots[at] = first;
}
