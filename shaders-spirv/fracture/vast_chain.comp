// Chains the sides of vast faces into loops. At a corner of several ways out each way in takes, of those that are left, the
// sharpest turn to the left. The lane of the lowest side into a corner serves all of them, so that ways in and out pair off.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

#include "lib/left_turns.glsl"
#include "lib/vast_face.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, VastFace, vast_faces);
READS(2, uvec4, vast_ends);
READS(3, ivec4, vast_chords);
layout(set = 0, binding = 4, std430) coherent buffer rings_block { uvec4 vast_rings[]; };
READS(5, uint, vast_heads);
READS(6, uint, vast_links);
#include "lib/vast_corners.glsl"

void join(uint into, uint out_) {
    vast_rings[into].x = out_;
    vast_rings[out_].y = into;
}

uint bestWayOut(uint into, uint first, uint end) {
    uint best = NO_INDEX;
    ivec2 here = vast_chords[into].zw, back = vast_chords[into].xy - here, best_way = ivec2(0);
    for (uint s = first; s < end; s++) {
        if (vast_ends[s].z == 0u || vast_rings[s].y != NO_INDEX) continue;
        ivec2 way = vast_chords[s].zw - here;
        if (best == NO_INDEX || furtherLeft(back, way, best_way)) {
            best = s;
            best_way = way;
        }
    }
    return best;
}

// The lowest side of the list that is not below the given one.
uint lowestFrom(uint head, uint from) {
    uint lowest = NO_INDEX;
    for (uint s = head; s != NO_INDEX; s = vast_links[s]) lowest = s >= from ? min(lowest, s) : lowest;
    return lowest;
}

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_VAST_SIDES] || counts[STATUS_FAILED] != 0u) return;
    uvec4 mine = vast_ends[k];
    if (mine.z == 0u) return;
    uint first = firstSideAt(mine.w, mine.y);
    if (!beginsAt(first, mine.w, mine.y)) return;
    uint head = vast_heads[first], end = endOfSidesAt(first, mine.w, mine.y);
    if (lowestFrom(head, 0u) != k) return;
    for (uint into = k; into != NO_INDEX; into = lowestFrom(head, into + 1u)) {
        uint best = bestWayOut(into, first, end);
        if (best != NO_INDEX) join(into, best);
    }
}
