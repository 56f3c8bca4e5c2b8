// Trapezoids of vast faces, and the diagonals that they give, a lane a corner. A trapezoid hangs from a corner, between two sides of
// the outline, and ends at the highest corner below it that lies between them. Where one side does not hold both corners, they
// are joined.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/left_turns.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec4, vast_ends);
READS(2, ivec4, vast_chords);
READS(3, uvec4, vast_rings);
READS(4, uint, vast_order);
READS(5, uint, span_offsets);
READS(6, uint, vast_spans);
WRITES(7, uvec2, vast_diagonals);
layout(set = 0, binding = 8, std430) coherent buffer heads_block { uint vast_heads[]; };
WRITES(9, uint, vast_links); // to the half-edge that was at the head of the list before
layout(push_constant) uniform Push { uint leaves; };
#include "lib/vast_sides.glsl"

// The sides to the left and to the right at the height of a corner, with the inside between them. The left
// one goes down, the right one up; NO_INDEX stands for an absent one.
struct Walls {
    uint left, right;
};

// Where a side is at some height: x and a fraction, and which way the side leans.
struct Crossing {
    int64_t x, part;
    ivec2 lean; // to its upper end
};

Crossing crossingAt(ivec2 low, ivec2 high, ivec2 at) {
    ivec2 lean = high - low;
    if (lean.y == 0) return Crossing(int64_t(at.x), int64_t(0), lean);
    int64_t along = int64_t(at.y - low.y) * int64_t(lean.x), x = along / int64_t(lean.y), part = along - x * int64_t(lean.y);
    bool is_short = isNegative(part); // division rounds towards zero
    return Crossing(int64_t(low.x) + x - (is_short ? int64_t(1) : int64_t(0)), part + (is_short ? int64_t(lean.y) : int64_t(0)), lean);
}

bool isUp(uint side) { return isLower(vast_chords[side].xy, vast_chords[side].zw); }

// Returns whether a lies further right than b, at one height. Lines of one height rise a little to the left, for of two corners of equal
// y the left one is lower. So of sides that share an end at that height the one that leans further to the right is nearer, from
// either side.
bool isFurther(Crossing a, Crossing b, uint side_a, uint side_b) {
    int whole = signOf(a.x - b.x), part = signOf(a.part * int64_t(b.lean.y) - b.part * int64_t(a.lean.y));
    int lean = signOf(int64_t(a.lean.x) * int64_t(b.lean.y) - int64_t(b.lean.x) * int64_t(a.lean.y));
    lean = isUp(side_a) ? -lean : lean;
    int order = whole != 0 ? whole : (part != 0 ? part : lean);
    return order != 0 ? order > 0 : side_a < side_b;
}

// Takes a side that is nearer than the wall so far.
void compareWall(inout Walls walls, inout Crossing left, inout Crossing right, uint s, ivec2 at) {
    ivec4 chord = vast_chords[s];
    bool up = isLower(chord.xy, chord.zw);
    ivec2 low = up ? chord.xy : chord.zw, high = up ? chord.zw : chord.xy;
    if (!isLower(low, at) || !isLower(at, high)) return;
    int side = turn(low, high, at);
    Crossing crossing = crossingAt(low, high, at);
    if (up && side >= 0 && (walls.right == NO_INDEX || isFurther(right, crossing, walls.right, s))) {
        walls.right = s;
        right = crossing;
    }
    if (!up && side <= 0 && (walls.left == NO_INDEX || isFurther(crossing, left, s, walls.left))) {
        walls.left = s;
        left = crossing;
    }
}

Walls wallsAt(uint corner) {
    Walls walls = Walls(NO_INDEX, NO_INDEX);
    Crossing left = Crossing(int64_t(0), int64_t(0), ivec2(0)), right = left;
    ivec2 at = placeOf(corner);
    for (uint node = leaves + vast_rings[corner].z; node != 0u; node >>= 1) {
        uint end = span_offsets[node + 1u];
        for (uint e = span_offsets[node]; e < end; e++) {
            compareWall(walls, left, right, vast_spans[e], at);
        }
    }
    return walls;
}

bool isBetween(Walls walls, ivec2 at) {
    ivec4 left = vast_chords[walls.left], right = vast_chords[walls.right];
    return turn(left.zw, left.xy, at) <= 0 && turn(right.xy, right.zw, at) >= 0;
}

// Returns whether a corner faces the place. A corner that touches a wall from outside does not.
bool faces(uint corner, ivec2 at) {
    uvec4 ring = vast_rings[corner];
    return inCone(placeOf(ring.y), placeOf(corner), placeOf(ring.x), at);
}

// The corner at which the trapezoid ends: at the lower end of a wall, if nowhere before.
uint endOfTrapezoid(uint top, Walls walls) {
    uint left_end = vast_rings[walls.left].x, right_end = walls.right, rank = vast_rings[top].z;
    ivec2 at = placeOf(top);
    for (uint step = 0u; step < MOST_TURNS && rank > 0u; step++) {
        uint k = vast_order[--rank];
        if (k == left_end || k == right_end) return k;
        if (vast_ends[k].z != 0u && isBetween(walls, placeOf(k)) && faces(k, at)) return k;
    }
    return isBelow(left_end, right_end) ? right_end : left_end;
}

void addToList(uint corner, uint half_) { vast_links[half_] = atomicExchange(vast_heads[corner], half_); }

void hangTrapezoid(uint top, uint number, Walls walls) {
    if (walls.left == NO_INDEX || walls.right == NO_INDEX) return;
    uint end = endOfTrapezoid(top, walls);
    bool is_side = (walls.left == top && vast_rings[top].x == end) || (walls.right == end && vast_rings[end].x == top);
    if (is_side || placeOf(end) == placeOf(top) || end == top) return;
    uint half_ = VAST_HALVES * top + 1u + 2u * number;
    vast_diagonals[2u * top + number] = uvec2(top, end);
    addToList(top, half_);
    addToList(end, half_ + 1u);
}

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_VAST_SIDES] || counts[STATUS_FAILED] != 0u) return;
    if (vast_ends[k].z == 0u) return;
    uint before = vast_rings[k].y, after = vast_rings[k].x;
    bool from_below = isBelow(before, k), to_below = isBelow(after, k);
    int bend = turn(placeOf(before), placeOf(k), placeOf(after));
    Walls walls = wallsAt(k);
    if (from_below && to_below && bend > 0) {
        hangTrapezoid(k, 0u, Walls(k, before));
    } else if (from_below || to_below) {
        if (from_below) hangTrapezoid(k, 0u, Walls(walls.left, before));
        if (to_below) hangTrapezoid(k, 1u, Walls(k, walls.right));
    } else if (bend < 0) {
        hangTrapezoid(k, 0u, walls);
    }
}
