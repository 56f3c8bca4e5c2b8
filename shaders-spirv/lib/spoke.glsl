// Triangles around an edge, by the angles of their third corners. An arm leads from the edge's lower end to such a corner; an arm along
// the edge has the angle 0. Places lie on a grid of 24 bits, so all signs are exact.

const uint MOST_AROUND_EDGE = 128u; // triangles
const float kTouch = 8.0;           // grid steps within which faces lie on each other

struct Edge {
    ivec3 low, way;
    ivec3 zero; // the arm whose angle is 0
};

Edge edgeFrom(ivec3 low, ivec3 high) { return Edge(low, high - low, ivec3(0)); }

int64_t minorOf(int ax, int ay, int bx, int by) { return int64_t(ax) * int64_t(by) - int64_t(ay) * int64_t(bx); }

struct Cross {
    int64_t x, y, z; // of 50 bits
};

Cross crossOf(ivec3 a, ivec3 b) { return Cross(minorOf(a.y, a.z, b.y, b.z), minorOf(a.z, a.x, b.z, b.x), minorOf(a.x, a.y, b.x, b.y)); }

int64_t dotOf(ivec3 a, ivec3 b) { return int64_t(a.x) * int64_t(b.x) + int64_t(a.y) * int64_t(b.y) + int64_t(a.z) * int64_t(b.z); }

bool isAlong(Edge e, ivec3 arm) {
    Cross c = crossOf(e.way, arm);
    return isZero(c.x) && isZero(c.y) && isZero(c.z);
}

// Positive where b lies at the greater angle, by less than half a turn.
Wide128 turnFrom(Edge e, ivec3 a, ivec3 b) {
    Cross c = crossOf(a, b);
    return wideAdd(wideAdd(wideMul(c.x, int64_t(e.way.x)), wideMul(c.y, int64_t(e.way.y))), wideMul(c.z, int64_t(e.way.z)));
}

// Positive where both lie on one side of the edge, seen along it.
Wide128 alignmentOf(Edge e, ivec3 a, ivec3 b) {
    return wideSub(wideMul(dotOf(e.way, e.way), dotOf(a, b)), wideMul(dotOf(e.way, a), dotOf(e.way, b)));
}

// Returns whether the angle is half a turn or more.
bool isInSecondHalf(Edge e, ivec3 arm) {
    int side = wideSign(turnFrom(e, e.zero, arm));
    return side < 0 || (side == 0 && wideSign(alignmentOf(e, e.zero, arm)) < 0);
}

// Negative where a lies at the lower angle.
int orderOf(Edge e, ivec3 a, ivec3 b) {
    a = isAlong(e, a) ? e.zero : a;
    b = isAlong(e, b) ? e.zero : b;
    bool a_late = isInSecondHalf(e, a), b_late = isInSecondHalf(e, b);
    return a_late != b_late ? (a_late ? 1 : -1) : -wideSign(turnFrom(e, a, b));
}

const float kShort = 1.4901161193847656e-8; // 2^-26, so that squares are floats

float floatOf(uint64_t a) {
    precise float sum = float(uint(a >> 32)) * 4294967296.0 + float(uint(a));
    return sum;
}

float shortFloat(int64_t a) { return floatOf(uint64_t(isNegative(a) ? -a : a)) * kShort; }

float shortFloat(Wide128 a) {
    if (isNegative(a.hi)) a = wideNegate(a);
    precise float sum = floatOf(uint64_t(a.hi)) * 18446744073709551616.0 + floatOf(a.lo);
    return sum * kShort;
}

float squareOf(Cross c) {
    float x = shortFloat(c.x), y = shortFloat(c.y), z = shortFloat(c.z);
    precise float sum = x * x + y * y + z * z;
    return sum;
}

// Returns whether one arm lies on the other but for a touch at the end of each. |e| ra rb sin(angle) is held against
// (ra + rb) |e| kTouch, where |e| r is the length of e x arm.
bool liesOn(Edge e, ivec3 a, ivec3 b) {
    a = isAlong(e, a) ? e.zero : a;
    b = isAlong(e, b) ? e.zero : b;
    if (wideSign(alignmentOf(e, a, b)) <= 0) return false;
    float turn = shortFloat(turnFrom(e, a, b));
    precise float bound = 2.0 * kTouch * kTouch * (squareOf(crossOf(e.way, a)) + squareOf(crossOf(e.way, b))), square = turn * turn;
    return square <= bound;
}
