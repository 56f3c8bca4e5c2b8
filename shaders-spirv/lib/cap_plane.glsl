#include "lib/wide.glsl"

// Caps are triangulated on whole numbers: the two coordinates that the bisector's normal leaves, in 1/64 grid steps, so that
// the polygon is counter-clockwise seen from the lower cell's outside and every test is exact in 64 bits.
struct CapPlane {
    uint u;
    uint w;
};

CapPlane capPlane(ivec3 qi, ivec3 qj) {
    ivec3 n = qj - qi, size = abs(n);
    uint axis = size.x >= size.y ? (size.x >= size.z ? 0u : 2u) : (size.y >= size.z ? 1u : 2u);
    uint u = (axis + 1u) % 3u, w = (axis + 2u) % 3u;
    return n[axis] < 0 ? CapPlane(w, u) : CapPlane(u, w);
}

int capCoordinate(uint id, uint axis) {
    uint64_t x = uint64_t(points[6u * id + 2u * axis]) | (uint64_t(points[6u * id + 2u * axis + 1u]) << 32);
    return int((x + uint64_t(1u << 17)) >> 18);
}

// Twice the area of a, b, c.
int64_t doubleArea(ivec2 a, ivec2 b, ivec2 c) {
    return int64_t(b.x - a.x) * int64_t(c.y - a.y) - int64_t(b.y - a.y) * int64_t(c.x - a.x);
}

// 1 for a left turn at b, -1 for a right turn, 0 for none.
int turn(ivec2 a, ivec2 b, ivec2 c) { return signOf(doubleArea(a, b, c)); }

// Whether x lies in the closed triangle a, b, c, which turns left. No loop: callers count their turns.
bool inTriangle(ivec2 a, ivec2 b, ivec2 c, ivec2 x) { return turn(a, b, x) >= 0 && turn(b, c, x) >= 0 && turn(c, a, x) >= 0; }

// Corners are rounded, so that outlines may cross themselves, or the surface touches itself: two grid steps.
const int64_t kTouch = int64_t(128);

int64_t reach(ivec2 a, ivec2 b) { return int64_t(abs(b.x - a.x)) + int64_t(abs(b.y - a.y)); }

// Whether the outline turns back on itself at b, or stands still, but for rounding: nothing lies between its edges.
bool isSpike(ivec2 a, ivec2 b, ivec2 c) {
    ivec2 u = a - b, w = c - b;
    int64_t area = doubleArea(a, b, c), longer = max(reach(a, b), reach(b, c));
    bool thin = signOf((isNegative(area) ? -area : area) - kTouch * longer) <= 0;
    bool back = signOf(int64_t(u.x) * int64_t(w.x) + int64_t(u.y) * int64_t(w.y)) > 0;
    return (thin && back) || u == ivec2(0) || w == ivec2(0);
}

bool isUpward(ivec2 d) { return d.y > 0 || (d.y == 0 && d.x > 0); }

// Whether the outline's direction turns through that of the first axis at b: 1 to the left, -1 to the right. Over a loop this
// adds up to how often it goes round: once, unless it crosses itself.
int roundTurn(ivec2 a, ivec2 b, ivec2 c) {
    bool before = isUpward(b - a), after = isUpward(c - b), left = turn(a, b, c) >= 0;
    return before == after || left != after ? 0 : (left ? 1 : -1);
}
