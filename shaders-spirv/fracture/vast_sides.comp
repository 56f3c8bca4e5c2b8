// Puts the sides of vast faces in order: by face, by the name of the corner where they begin, and by source, for segments lie
// as atomics left them. Notes the places of their corners and makes room for their half-edges.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ivec4, sites);
READS(2, uint, faces);
READS(3, uint, neighbors);
READS(4, uint, face_cells);
READS(5, uint, points);
#include "lib/cap_plane.glsl"
#include "lib/vast_face.glsl"
UPDATES(6, VastFace, vast_faces);
READS(7, uvec4, listed);
READS(8, uint, values); // listed sides, by face and name
WRITES(9, uvec4, vast_ends);
WRITES(10, ivec4, vast_chords);
WRITES(11, uvec2, vast_diagonals);
WRITES(12, uint, vast_heads);
WRITES(13, uint, vast_flags); // of half-edges: their corner is a triangle of the cap

bool beginsWith(uint at, uvec4 side) {
    if (at >= counts[COUNT_VAST_SIDES]) return false;
    uvec4 other = listed[values[at]];
    return other.x == side.x && other.w == side.w;
}

// Where the side belongs among those that begin at its corner.
uint placeInOrder(uint at, uvec4 side) {
    uint first = at, other = at, lower = 0u;
    bool goes_on = true;
    for (uint step = 0u; step < MOST_TURNS / 2u && goes_on; step++) {
        lower += listed[values[first]].z < side.z ? 1u : 0u;
        goes_on = first > 0u && beginsWith(first - 1u, side);
        first -= goes_on ? 1u : 0u;
    }
    goes_on = beginsWith(other + 1u, side);
    for (uint step = 0u; step < MOST_TURNS / 2u && goes_on; step++) {
        other++;
        lower += listed[values[other]].z < side.z ? 1u : 0u;
        goes_on = beginsWith(other + 1u, side);
    }
    return first + lower;
}

ivec2 placeIn(CapPlane plane, uint name) { return ivec2(capCoordinate(name, plane.u), capCoordinate(name, plane.w)); }

void main() {
    uint at = flatIndex();
    if (at >= counts[COUNT_VAST_SIDES] || counts[STATUS_FAILED] != 0u) return;
    uvec4 side = listed[values[at]];
    uint k = placeInOrder(at, side), f = faces[vast_faces[side.w].index];
    if (at == 0u || listed[values[at - 1u]].w != side.w) vast_faces[side.w].first = at; // in the order of the sort
    CapPlane plane = capPlane(sites[face_cells[f]].xyz, sites[neighbors[f]].xyz);
    vast_ends[k] = uvec4(side.xy, 0u, side.w);
    vast_chords[k] = ivec4(placeIn(plane, side.x), placeIn(plane, side.y));
    vast_diagonals[2u * k] = uvec2(NO_INDEX);
    vast_diagonals[2u * k + 1u] = uvec2(NO_INDEX);
    vast_heads[k] = NO_INDEX;
    for (uint part = 0u; part < VAST_HALVES; part++) vast_flags[VAST_HALVES * k + part] = 0u;
}
