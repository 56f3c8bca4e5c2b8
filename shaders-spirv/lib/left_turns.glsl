// Turns of outlines whose corners have whole coordinates; all tests are exact in 64 bits.
#ifndef LEFT_TURNS_GLSL
#define LEFT_TURNS_GLSL
#include "lib/wide.glsl"

// Twice the area of a, b, c.
int64_t doubleArea(ivec2 a, ivec2 b, ivec2 c) {
    return int64_t(b.x - a.x) * int64_t(c.y - a.y) - int64_t(b.y - a.y) * int64_t(c.x - a.x);
}

// 1 for a left turn at b, -1 for a right turn, 0 for none.
int turn(ivec2 a, ivec2 b, ivec2 c) { return signOf(doubleArea(a, b, c)); }

// Returns whether x lies in the closed triangle a, b, c, which turns left. No loop: callers count their turns.
bool inTriangle(ivec2 a, ivec2 b, ivec2 c, ivec2 x) { return turn(a, b, x) >= 0 && turn(b, c, x) >= 0 && turn(c, a, x) >= 0; }

// Corners are rounded, so that outlines may cross themselves, or the surface touches itself: two grid steps.
const int64_t kTouch = int64_t(128);

int64_t reach(ivec2 a, ivec2 b) { return int64_t(abs(b.x - a.x)) + int64_t(abs(b.y - a.y)); }

// Returns whether the outline turns back on itself at b, or stands still, but for rounding. Then nothing lies between its edges.
bool isSpike(ivec2 a, ivec2 b, ivec2 c) {
    ivec2 u = a - b, w = c - b;
    int64_t area = doubleArea(a, b, c), longer = max(reach(a, b), reach(b, c));
    bool thin = signOf((isNegative(area) ? -area : area) - kTouch * longer) <= 0;
    bool back = signOf(int64_t(u.x) * int64_t(w.x) + int64_t(u.y) * int64_t(w.y)) > 0;
    return (thin && back) || u == ivec2(0) || w == ivec2(0);
}

bool isUpward(ivec2 d) { return d.y > 0 || (d.y == 0 && d.x > 0); }

// Returns whether the outline's direction turns through that of the first axis at b: 1 to the left, -1 to the right. Over a loop this
// adds up to how often it goes round: once, unless it crosses itself.
int roundTurn(ivec2 a, ivec2 b, ivec2 c) {
    bool before = isUpward(b - a), after = isUpward(c - b), left = turn(a, b, c) >= 0;
    return before == after || left != after ? 0 : (left ? 1 : -1);
}

// Which of two ways out turns further left, looking back along the way in: 0 right of back ... 3 back itself.
int sectorOf(ivec2 back, ivec2 d) {
    int64_t cross_ = int64_t(back.x) * int64_t(d.y) - int64_t(back.y) * int64_t(d.x);
    int64_t dot_ = int64_t(back.x) * int64_t(d.x) + int64_t(back.y) * int64_t(d.y);
    return isNegative(cross_) ? 0 : (signOf(cross_) > 0 ? 2 : (isNegative(dot_) ? 1 : 3));
}

bool furtherLeft(ivec2 back, ivec2 a, ivec2 b) {
    int sa = sectorOf(back, a), sb = sectorOf(back, b);
    return sa != sb ? sa < sb : isNegative(int64_t(a.x) * int64_t(b.y) - int64_t(a.y) * int64_t(b.x));
}

// Returns whether x lies within the corner or on its sides. Where the corner turns left, that is to the left of both.
bool inCone(ivec2 before, ivec2 c, ivec2 after, ivec2 x) {
    bool convex = turn(before, c, after) >= 0;
    ivec2 first = convex ? before : after, second = convex ? after : before;
    bool between = turn(c, x, first) >= 0 && turn(c, second, x) >= 0;
    return convex ? between : !between;
}

#endif
