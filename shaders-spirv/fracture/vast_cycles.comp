// Finds what follows each half-edge of vast faces. Of the sides and diagonals that leave the corner where it ends, it is the one
// that turns furthest to the left, for the parts lie to the left of their half-edges.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/left_turns.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec4, vast_ends);
READS(2, ivec4, vast_chords);
READS(3, uvec4, vast_rings);
READS(4, uvec2, vast_diagonals);
READS(5, uint, vast_heads);
READS(6, uint, vast_links);
UPDATES(7, uvec2, vast_halves); // next, previous; NO_INDEX for absent half-edges
#include "lib/vast_halves.glsl"
#include "lib/vast_sides.glsl"

// Returns how far it is from one direction to another, counter-clockwise: 0 no way, 1 less than half a turn, 2 half a turn, 3 more.
int quadrantOf(ivec2 from, ivec2 to) {
    int side = signOf(int64_t(from.x) * int64_t(to.y) - int64_t(from.y) * int64_t(to.x));
    bool ahead = signOf(int64_t(from.x) * int64_t(to.x) + int64_t(from.y) * int64_t(to.y)) > 0;
    return side > 0 ? 1 : (side < 0 ? 3 : (ahead ? 0 : 2));
}

struct Spoke {
    uint half_; // that leaves the corner
    ivec2 way;
};

// Returns whether a comes before b, counter-clockwise from the direction of the corner's own side.
bool comesBefore(ivec2 from, Spoke a, Spoke b) {
    int qa = quadrantOf(from, a.way), qb = quadrantOf(from, b.way);
    int side = signOf(int64_t(a.way.x) * int64_t(b.way.y) - int64_t(a.way.y) * int64_t(b.way.x));
    return qa != qb ? qa < qb : (side != 0 ? side > 0 : a.half_ < b.half_);
}

Spoke spokeOf(uint half_, uint corner) { return Spoke(half_, placeOf(originOf(twinOf(half_))) - placeOf(corner)); }

// Returns the last diagonal at the corner before the given one, or the last of all for NO_INDEX. If the corner has no such diagonal,
// its own side is returned.
uint lastBefore(uint corner, uint half_) {
    ivec2 from = vast_chords[corner].zw - placeOf(corner);
    bool all = half_ == NO_INDEX;
    Spoke end = all ? Spoke(NO_INDEX, ivec2(0)) : spokeOf(half_, corner), best = end;
    bool found = false;
    uint at = vast_heads[corner];
    for (uint step = 0u; step < MOST_TURNS && at != NO_INDEX; step++) {
        Spoke spoke = spokeOf(at, corner);
        bool before = all || (at != half_ && comesBefore(from, spoke, end));
        if (before && (!found || comesBefore(from, best, spoke))) {
            best = spoke;
            found = true;
        }
        at = vast_links[at];
    }
    return found ? best.half_ : VAST_HALVES * corner;
}

void main() {
    uint h = flatIndex();
    if (h >= counts[COUNT_VAST_HALVES] || counts[STATUS_FAILED] != 0u) return;
    uint corner = originOf(h);
    if (corner == NO_INDEX || vast_ends[h / VAST_HALVES].z == 0u) {
        vast_halves[h] = uvec2(NO_INDEX);
        return;
    }
    bool is_side = isSideItself(h);
    uint next = is_side ? lastBefore(vast_rings[corner].x, NO_INDEX) : lastBefore(originOf(twinOf(h)), twinOf(h));
    vast_halves[h].x = next;
    vast_halves[next].y = h;
}
