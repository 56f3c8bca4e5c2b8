// Triangulates what ears have left of the parts of vast faces, a lane a part. It walks the corners of the mountain in order and
// cuts each that turns left, which may let the one before it turn left as well. What rounding has made no mountain is cut in
// order.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/left_turns.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uvec4, vast_ends);
READS(2, ivec4, vast_chords);
READS(3, uvec2, vast_diagonals);
UPDATES(4, uvec2, vast_halves);
READS(5, uvec2, vast_labels);
UPDATES(6, uint, vast_flags);
WRITES(7, uint, vast_caps);
#include "lib/vast_halves.glsl"
#include "lib/vast_sides.glsl"
#include "lib/vast_ears.glsl"

struct Part {
    uint begin, end; // ends of the long edge
    uint count;      // corners
};

// The long edge joins the highest corner and the lowest.
Part measurePart(uint h) {
    uint top = h, bottom = h, count = 1u;
    for (uint at = vast_halves[h].x; at != h && count < MOST_TURNS; at = vast_halves[at].x) {
        if (isBelow(originOf(top), originOf(at))) top = at;
        if (isBelow(originOf(at), originOf(bottom))) bottom = at;
        count++;
    }
    bool goes_down = vast_halves[top].x == bottom;
    return goes_down ? Part(bottom, top, count) : Part(top, vast_halves[top].y, count);
}

bool turnsLeft(uint h) {
    return turn(placeOf(originOf(vast_halves[h].y)), placeOf(originOf(h)), placeOf(originOf(vast_halves[h].x))) > 0;
}

void cutMountain(inout Part part) {
    uint at = vast_halves[part.begin].x;
    for (uint step = 0u; step < MOST_TURNS && part.count > 3u && at != part.end; step++) {
        uvec2 around = vast_halves[at];
        bool ear = turnsLeft(at);
        if (ear) {
            cutEar(at);
            part.count--;
        }
        at = ear && around.y != part.begin ? around.y : around.x;
    }
}

void cutRest(Part part) {
    uint at = vast_halves[part.begin].x;
    for (; part.count > 2u; part.count--) {
        uint next = vast_halves[at].x;
        cutEar(at);
        at = next;
    }
}

void main() {
    uint h = flatIndex();
    if (h >= counts[COUNT_VAST_HALVES] || counts[STATUS_FAILED] != 0u) return;
    if (vast_halves[h].x == NO_INDEX || vast_labels[h].x != h) return;
    Part part = measurePart(h);
    if (part.count >= MOST_TURNS / 3u) {
        atomicAdd(counts[STATUS_BAD_CAP], 1u);
        return;
    }
    cutMountain(part);
    cutRest(part);
}
