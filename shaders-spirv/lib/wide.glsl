// Fixed-width integers for the exact predicates.
//
// A corner value D is at most 51 bits wide on a 24-bit grid; the predicates multiply two, three or four such values, so
// their signs need 102, 127, 153 or 178 bits. Sums never leave the widths named here, so plain two's complement words with
// carries are enough, and there is nothing to round.
#ifndef WIDE_GLSL
#define WIDE_GLSL

// Signs are read from the top word: Mesa 22.3 gets (int64_t(int32) < 0) wrong.
bool isNegative(int64_t a) { return int(uint(uint64_t(a) >> 32)) < 0; }
bool isZero(int64_t a) { return (uint(uint64_t(a) >> 32) | uint(uint64_t(a))) == 0u; }
int signOf(int64_t a) { return isNegative(a) ? -1 : (isZero(a) ? 0 : 1); }

int64_t squaredLength(ivec3 d) { return int64_t(d.x) * int64_t(d.x) + int64_t(d.y) * int64_t(d.y) + int64_t(d.z) * int64_t(d.z); }

struct Wide128 {
    uint64_t lo;
    int64_t hi;
};

struct Wide192 {
    uint64_t w0;
    uint64_t w1;
    int64_t w2;
};

Wide128 wideFrom(int64_t a) { return Wide128(uint64_t(a), a >> 63); }

Wide128 wideAdd(Wide128 a, Wide128 b) {
    uint64_t lo = a.lo + b.lo;
    return Wide128(lo, a.hi + b.hi + (lo < a.lo ? int64_t(1) : int64_t(0)));
}

Wide128 wideNegate(Wide128 a) {
    uint64_t lo = ~a.lo + uint64_t(1);
    return Wide128(lo, ~a.hi + (lo == uint64_t(0) ? int64_t(1) : int64_t(0)));
}

Wide128 wideSub(Wide128 a, Wide128 b) {
    uint64_t lo = a.lo - b.lo;
    return Wide128(lo, a.hi - b.hi - (a.lo < b.lo ? int64_t(1) : int64_t(0)));
}

int wideSign(Wide128 a) {
    return isNegative(a.hi) ? -1 : ((a.lo | uint64_t(a.hi)) != uint64_t(0) ? 1 : 0);
}

bool wideLess(Wide128 a, Wide128 b) { return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo); }

Wide128 wideDouble(Wide128 a) {
    return Wide128(a.lo << 1, int64_t((uint64_t(a.hi) << 1) | (a.lo >> 63)));
}

Wide128 wideShiftLeft25(Wide128 a) {
    return Wide128(a.lo << 25, int64_t((uint64_t(a.hi) << 25) | (a.lo >> 39)));
}

// Product of two values of at most 53 bits each: the middle terms then fit one word without a carry.
Wide128 wideMul(int64_t a, int64_t b) {
    uint64_t al = uint64_t(uint(a)), bl = uint64_t(uint(b));
    int64_t ah = a >> 32, bh = b >> 32;
    uint64_t ll = al * bl;
    int64_t mid = ah * int64_t(bl) + int64_t(al) * bh + int64_t(ll >> 32);
    return Wide128((uint64_t(mid) << 32) | (ll & uint64_t(0xffffffffu)), ah * bh + (mid >> 32));
}

// Unsigned 64 x 64 -> 128.
Wide128 wideMulUnsigned(uint64_t a, uint64_t b) {
    uint64_t al = uint64_t(uint(a)), ah = a >> 32, bl = uint64_t(uint(b)), bh = b >> 32;
    uint64_t ll = al * bl, lh = al * bh, hl = ah * bl;
    uint64_t mid = (ll >> 32) + uint64_t(uint(lh)) + uint64_t(uint(hl));
    return Wide128((mid << 32) | uint64_t(uint(ll)), int64_t(ah * bh + (lh >> 32) + (hl >> 32) + (mid >> 32)));
}

// Low 128 bits of a 128-bit by 64-bit product, which is all of it where the caller knows that it fits.
Wide128 wideScale(Wide128 a, int64_t b) {
    Wide128 p = wideMulUnsigned(a.lo, uint64_t(b));
    uint64_t top = uint64_t(a.hi) * uint64_t(b) - (isNegative(b) ? a.lo : uint64_t(0));
    return Wide128(p.lo, p.hi + int64_t(top));
}

Wide192 wideAdd(Wide192 a, Wide192 b) {
    uint64_t w0 = a.w0 + b.w0;
    uint64_t c0 = w0 < a.w0 ? uint64_t(1) : uint64_t(0);
    uint64_t w1 = a.w1 + b.w1;
    uint64_t c1 = w1 < a.w1 ? uint64_t(1) : uint64_t(0);
    uint64_t s1 = w1 + c0;
    c1 += s1 < w1 ? uint64_t(1) : uint64_t(0);
    return Wide192(w0, s1, a.w2 + b.w2 + int64_t(c1));
}

int wideSign(Wide192 a) {
    return isNegative(a.w2) ? -1 : ((a.w0 | a.w1 | uint64_t(a.w2)) != uint64_t(0) ? 1 : 0);
}

// Product modulo 2^192: exact for factors that are together less than 191 bits wide.
Wide192 wideMul192(Wide128 a, Wide128 b) {
    uint64_t a1 = uint64_t(a.hi), b1 = uint64_t(b.hi);
    Wide128 p = wideMulUnsigned(a.lo, b.lo), q = wideMulUnsigned(a.lo, b1), r = wideMulUnsigned(a1, b.lo);
    uint64_t w1 = uint64_t(p.hi) + q.lo;
    uint64_t carry = w1 < q.lo ? uint64_t(1) : uint64_t(0);
    uint64_t s1 = w1 + r.lo;
    carry += s1 < r.lo ? uint64_t(1) : uint64_t(0);
    uint64_t w2 = uint64_t(q.hi) + uint64_t(r.hi) + a1 * b1 + carry;
    w2 -= isNegative(a.hi) ? b.lo : uint64_t(0);
    w2 -= isNegative(b.hi) ? a.lo : uint64_t(0);
    return Wide192(p.lo, s1, int64_t(w2));
}

// a.x*b.y - a.y*b.x for values of at most 51 bits.
Wide128 wideMinor(int64_t ax, int64_t ay, int64_t bx, int64_t by) { return wideSub(wideMul(ax, by), wideMul(ay, bx)); }

#endif
