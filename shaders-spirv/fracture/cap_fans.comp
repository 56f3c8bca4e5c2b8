// Caps as fans from a corner that sees the whole of them, a workgroup a face. Most caps have one among their corners on Voronoi
// edges, also where the surface is wavy. Those that have none go to cap_faces_large.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

#define MOST_CANDIDATES 32u
GROUP_KERNEL;
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
READS(11, uint, wide_faces);
WRITES(12, uint, large_faces);
WRITES(13, uint, huge_faces);
WRITES(14, uint, cap_slots);
#include "lib/vast_face.glsl"
WRITES(15, VastFace, vast_faces);
#include "lib/vast_list.glsl"
#include "lib/cap_plane.glsl"
#include "lib/fan.glsl"

shared uint candidates[MOST_CANDIDATES];
shared ivec2 candidate_places[MOST_CANDIDATES];
shared uint candidate_total, blind;

ivec2 placeOf(uint id, CapPlane plane) { return ivec2(capCoordinate(id, plane.u), capCoordinate(id, plane.w)); }

// Corners on Voronoi edges; where there are none, or too many, the corner with the greatest name.
void listCandidates(uint lane, CapPlane plane) {
    uint first_triple = counts[COUNT_MESH_VERTICES] + counts[COUNT_CROSSINGS];
    for (uint k = lane; k < n; k += GROUP_SIZE) {
        uvec4 s = segments[first + k];
        uint name = welded[s.x];
        if (isSide(s)) atomicMax(greatest, name);
        if (isSide(s) && name >= first_triple) {
            uint at = atomicAdd(candidate_total, 1u);
            if (at < MOST_CANDIDATES) candidates[at] = name;
        }
    }
    barrier();
    if (lane == 0u && (candidate_total == 0u || candidate_total > MOST_CANDIDATES)) {
        candidate_total = 1u;
        candidates[0] = greatest;
    }
    barrier();
    if (lane < candidate_total) candidate_places[lane] = placeOf(candidates[lane], plane);
    barrier();
}

// Candidates, a bit each, whose triangle with this side does not turn left.
uint blindTowards(uvec4 s, CapPlane plane) {
    uint a = welded[s.x], b = welded[s.y], found = 0u;
    ivec2 pa = placeOf(a, plane), pb = placeOf(b, plane);
    for (uint c = 0u; c < candidate_total; c++) {
        bool spoke = candidates[c] == a || candidates[c] == b;
        found |= !spoke && turn(candidate_places[c], pa, pb) <= 0 ? 1u << c : 0u;
    }
    return a != b ? found : 0u;
}

// Of the candidates that see the whole cap the one with the greatest name; NO_INDEX if there is none.
uint findCorner(uint lane, CapPlane plane) {
    listCandidates(lane, plane);
    uint found = 0u;
    for (uint k = lane; k < n; k += GROUP_SIZE) found |= blindTowards(segments[first + k], plane);
    if (found != 0u) atomicOr(blind, found);
    barrier();
    uint corner = NO_INDEX;
    for (uint c = 0u; c < candidate_total; c++) {
        bool sees = ((blind >> c) & 1u) == 0u;
        if (sees && (corner == NO_INDEX || candidates[c] > corner)) corner = candidates[c];
    }
    return corner;
}

void saveFan(uint lane, uint corner) {
    loadSources(lane);
    barrier();
    for (uint k = lane; k < n; k += GROUP_SIZE) {
        uvec4 s = segments[first + k];
        uint a = welded[s.x], b = welded[s.y];
        saveTriangle(first + rankOf(s.z), a != b && a != corner && b != corner, corner, a, b);
    }
    barrier();
}

void passOn(uint index, uint size) {
    if (size > HUGE_FACE) {
        listVast(index, size);
        return;
    }
    cap_slots[index] = counts[COUNT_SEGMENTS] + atomicAdd(counts[COUNT_NODES], 2u * size); // whoever comes first
    if (size <= LARGE_FACE) large_faces[atomicAdd(counts[COUNT_LARGE_FACES], 1u)] = index;
    else huge_faces[atomicAdd(counts[COUNT_HUGE_FACES], 1u)] = index;
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
        candidate_total = 0u;
        blind = size <= HUGE_FACE ? 0u : NO_INDEX;
    }
    barrier();
    uint corner = findCorner(lane, capPlane(sites[idle ? 0u : face_cells[f]].xyz, sites[idle ? 0u : neighbors[f]].xyz));
    n = corner != NO_INDEX ? n : 0u;
    saveFan(lane, corner);
    if (lane == 0u && !idle) {
        if (corner == NO_INDEX) {
            passOn(index, size);
        } else {
            cap_counts[index] = made;
            cap_slots[index] = first;
        }
    }
}
