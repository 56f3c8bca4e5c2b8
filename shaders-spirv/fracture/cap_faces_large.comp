// Triangulates any cap, a workgroup a face: opposite edges cancel, the rest is chained into loops (at a shared corner by the
// sharpest left turn), holes are joined to the loop around them by bridges, and ears are clipped many at a time.
//
// Whatever the rounding of corners does, the outcome is closed: each step of ear clipping keeps the directed boundary, so
// n corners and h holes give n - 2 + 2h triangles whose outline is the input's. Only looks can suffer, and triangles that
// come out turned over are counted.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/precision.glsl"

#ifndef LANES
#define LANES 64
#define MAX_SEGMENTS LARGE_FACE
#define LIST_COUNT COUNT_LARGE_FACES
#endif
#define MAX_NODES (2 * MAX_SEGMENTS)
#define TURNS (MAX_NODES / LANES)
#define MAX_LOOPS (MAX_SEGMENTS / 3 + 1)
layout(local_size_x = LANES) in;
UPDATES(0, uint, counts);
READS(1, ivec4, sites);
READS(2, uint, faces);
READS(3, uint, neighbors);
READS(4, uint, face_cells);
READS(5, uint, face_offsets);
READS(6, uvec4, segments);
READS(7, uint, welded);
READS(8, uint, points);
WRITES(9, uint, loose_caps);
WRITES(10, uint, cap_counts);
READS(11, uint, large_faces);
layout(set = 0, binding = 12, std430) coherent buffer nodes_block { ivec4 nodes[]; }; // x, y, name, state
layout(set = 0, binding = 13, std430) coherent buffer rings_block { uvec4 rings[]; }; // next, previous, loop, scratch
layout(set = 0, binding = 14, std430) coherent buffer loops_block { ivec4 loops[]; }; // of a loop's first node: turns left?, rightmost
READS(15, uint, cap_slots);
#include "lib/cap_plane.glsl"
#include "lib/cap_loops.glsl"
#include "lib/cap_holes.glsl"
#include "lib/cap_ears.glsl"

// Takes the face's part of the pools, and returns how many sides it has; none where it is too long.
uint openFace(uint lane, uint index, bool idle) {
    uint f = faces[index], n = idle ? 0u : face_offsets[f + 1u] - face_offsets[f];
    if (n > MAX_SEGMENTS) {
        if (lane == 0u) {
            atomicAdd(counts[STATUS_BAD_CAP], 1u);
            cap_counts[index] = 0u;
        }
        n = 0u;
    }
    CapPlane plane = capPlane(sites[face_cells[f]].xyz, sites[neighbors[f]].xyz);
    slots = cap_slots[index];
    base = slots - counts[COUNT_SEGMENTS];
    plane_u = plane.u;
    plane_w = plane.w;
    for (uint k = lane; k < 2u * n; k += LANES) {
        loose_caps[3u * (slots + k)] = NO_INDEX;
        nodes[base + k] = ivec4(0);
    }
    sync();
    return n;
}

// Returns how many of its sides there are after that: none where they do not close.
uint makeLoops(uint lane, uint index, uint n) {
    loadEdges(lane, face_offsets[faces[index]], n);
    chainEdges(lane, n);
    bool open = !kExact && hasGaps(lane, n);
    if (open && lane == 0u) {
        atomicAdd(counts[STATUS_OPEN_OUTLINES], 1u);
        atomicOr(counts[STATUS_FAILED], FAILED_CLIP);
        cap_counts[index] = 0u;
    }
    n = open ? 0u : n;
    labelLoops(lane, n);
    measureLoops(lane, n);
    if (lane == 0u && (hole_total > MAX_LOOPS || outer_total > MAX_LOOPS)) atomicAdd(counts[STATUS_BAD_CAP], 1u);
    return n;
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    bool failed = counts[STATUS_FAILED] != 0u;
    uint index = large_faces[min(flatGroup(), max(counts[LIST_COUNT], 1u) - 1u)];
    index = failed ? 0u : index;
    uint n = makeLoops(lane, index, openFace(lane, index, failed));
    orderHoles(lane);
    bridgeHoles(lane);
    bool finished;
    uint made = clipEars(lane, finished);
    if (lane == 0u && n > 0u) cap_counts[index] = made;
    if (lane == 0u && !finished) atomicAdd(counts[STATUS_BAD_CAP], 1u);
}
