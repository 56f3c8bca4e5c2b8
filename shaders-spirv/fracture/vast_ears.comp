// One round of ears in the parts of vast faces. Runs twice: first corners that turn left are marked, then each goes whose mark is
// higher than those of its neighbors. In a mountain, all corners but the highest and the lowest have one neighbor above and one
// below, and those that turn left are ears.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/left_turns.glsl"

layout(constant_id = 0) const uint kCut = 0u;
FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uvec4, vast_ends);
READS(2, ivec4, vast_chords);
READS(3, uvec2, vast_diagonals);
UPDATES(4, uvec2, vast_halves);
UPDATES(5, uint, vast_marks);
UPDATES(6, uint, vast_flags);
WRITES(7, uint, vast_caps); // names of three corners
#include "lib/vast_halves.glsl"
#include "lib/vast_sides.glsl"
#include "lib/vast_ears.glsl"

bool isEar(uint h) {
    uint a = originOf(vast_halves[h].y), k = originOf(h), c = originOf(vast_halves[h].x);
    bool is_last = vast_halves[vast_halves[h].x].x == vast_halves[h].y;
    return !is_last && isBelow(a, k) != isBelow(c, k) && turn(placeOf(a), placeOf(k), placeOf(c)) > 0;
}

uint priorityOf(uint h) { return ((h * 0x9e3779b1u) ^ (h >> 7)) | 1u; }

bool goesFirst(uint h, uint other) {
    uint mine = vast_marks[h], its = vast_marks[other];
    return mine > its || (mine == its && h > other);
}

void main() {
    uint h = flatIndex();
    if (h >= counts[COUNT_VAST_HALVES] || counts[STATUS_FAILED] != 0u) return;
    uvec2 around = vast_halves[h];
    if (kCut == 0u) {
        vast_marks[h] = around.x != NO_INDEX && isEar(h) ? priorityOf(h) : 0u;
    } else if (vast_marks[h] != 0u && goesFirst(h, around.x) && goesFirst(h, around.y)) {
        cutEar(h);
    }
}
