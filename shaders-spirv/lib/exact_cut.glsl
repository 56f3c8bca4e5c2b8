// The one symmetric question of a Voronoi diagram: does site e cut the corner (self; a, b, c)?
//
// Coordinates are relative to the cell's own site: plane of a site is d.w <= r with d = q - self, r = d.d and w = 2 (v - self);
// a wall of the box has an axis for d and twice its distance for r. Corner of three planes is w = moment / volume with
//   moment = r_a (b x c) + r_b (c x a) + r_c (a x b),   volume = a . (b x c) > 0,
// so the question is the sign of e.moment - r_e volume: the in-sphere determinant of five sites, at most 127 bits on a
// 24-bit grid. All five cells ask the same determinant, hence agree. Ties are decided by simulation of simplicity
// (Edelsbrunner and Muecke 1990): site s weighs eps^(s+1), a lower id wins; walls are not perturbed.
#include "lib/wide.glsl"

struct Plane {
    ivec3 d;
    uint id;
    int64_t r;
};

struct Corner {
    Wide128 moment[3];
    Wide128 volume;
};

// Of the site that is d away.
Plane bisectorOf(ivec3 d, uint id) { return Plane(d, id, squaredLength(d)); }

// Wall k of the box, which stands in the order of their ids.
Plane wallOf(uint k, ivec3 site, ivec3 low, ivec3 high) {
    uint axis = k >> 1;
    bool upper = (k & 1u) != 0u;
    ivec3 d = ivec3(0);
    d[axis] = upper ? 1 : -1;
    return Plane(d, BOX_BASE + k, int64_t(2 * (upper ? high[axis] - site[axis] : site[axis] - low[axis])));
}

int64_t crossTerm(int ax, int ay, int bx, int by) { return int64_t(ax) * int64_t(by) - int64_t(ay) * int64_t(bx); }

Wide128 volumeOf(ivec3 a, ivec3 b, ivec3 c) {
    Wide128 x = wideMul(int64_t(a.x), crossTerm(b.y, b.z, c.y, c.z));
    Wide128 y = wideMul(int64_t(a.y), crossTerm(b.z, b.x, c.z, c.x));
    Wide128 z = wideMul(int64_t(a.z), crossTerm(b.x, b.y, c.x, c.y));
    return wideAdd(wideAdd(x, y), z);
}

Wide128 momentTerm(Plane a, Plane b, Plane c, int64_t bc, int64_t ca, int64_t ab) {
    return wideAdd(wideAdd(wideMul(a.r, bc), wideMul(b.r, ca)), wideMul(c.r, ab));
}

Corner cornerOf(Plane a, Plane b, Plane c) {
    Corner t;
    t.moment[0] = momentTerm(a, b, c, crossTerm(b.d.y, b.d.z, c.d.y, c.d.z), crossTerm(c.d.y, c.d.z, a.d.y, a.d.z),
                             crossTerm(a.d.y, a.d.z, b.d.y, b.d.z));
    t.moment[1] = momentTerm(a, b, c, crossTerm(b.d.z, b.d.x, c.d.z, c.d.x), crossTerm(c.d.z, c.d.x, a.d.z, a.d.x),
                             crossTerm(a.d.z, a.d.x, b.d.z, b.d.x));
    t.moment[2] = momentTerm(a, b, c, crossTerm(b.d.x, b.d.y, c.d.x, c.d.y), crossTerm(c.d.x, c.d.y, a.d.x, a.d.y),
                             crossTerm(a.d.x, a.d.y, b.d.x, b.d.y));
    t.volume = volumeOf(a.d, b.d, c.d);
    return t;
}

// By magnitude: the low word of a small negative value is all but full and would drown it.
float wideToFloat(Wide128 a) {
    bool negative = isNegative(a.hi);
    Wide128 m = negative ? wideNegate(a) : a;
    float f = float(uint64_t(m.hi)) * 18446744073709551616.0 + float(m.lo);
    return negative ? -f : f;
}

// w in fp32: correct to a few roundings, since the integers are.
vec3 placeOf(Corner t) {
    float inverse = 1.0 / wideToFloat(t.volume);
    return vec3(wideToFloat(t.moment[0]), wideToFloat(t.moment[1]), wideToFloat(t.moment[2])) * inverse;
}

void decideTie(inout uint lowest, inout int verdict, uint id, int coefficient) {
    if (coefficient != 0 && id < lowest) {
        lowest = id;
        verdict = coefficient;
    }
}

bool tieCuts(uint self, Plane a, Plane b, Plane c, Plane e) {
    Wide128 ka = volumeOf(e.d, b.d, c.d), kb = volumeOf(a.d, e.d, c.d), kc = volumeOf(a.d, b.d, e.d);
    Wide128 ke = wideNegate(volumeOf(a.d, b.d, c.d));
    Wide128 zero = Wide128(uint64_t(0), int64_t(0));
    Wide128 own = wideAdd(wideAdd(a.id < BOX_BASE ? ka : zero, b.id < BOX_BASE ? kb : zero),
                          wideAdd(c.id < BOX_BASE ? kc : zero, ke));
    uint lowest = BOX_BASE;
    int verdict = -1;
    decideTie(lowest, verdict, self, wideSign(own));
    decideTie(lowest, verdict, a.id, -wideSign(ka));
    decideTie(lowest, verdict, b.id, -wideSign(kb));
    decideTie(lowest, verdict, c.id, -wideSign(kc));
    decideTie(lowest, verdict, e.id, -wideSign(ke));
    return verdict > 0;
}

int sideOf(Corner t, Plane e) {
    Wide128 s = wideAdd(wideScale(t.moment[0], int64_t(e.d.x)), wideScale(t.moment[1], int64_t(e.d.y)));
    s = wideAdd(s, wideScale(t.moment[2], int64_t(e.d.z)));
    return wideSign(wideSub(s, wideScale(t.volume, e.r)));
}
