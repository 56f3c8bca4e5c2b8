// Where combinatorial vertices lie: fixed-point grid coordinates with 24 binary places, for equality and for cap decisions,
// and model coordinates for output. A quotient is floor(2^b x) of the exact rational x, by long division: it depends on the
// value alone, so points that coincide get the same bits whatever ids name them.
#include "lib/wide.glsl"

void savePoint(uint id, int64_t x, int64_t y, int64_t z) {
    points[6u * id] = uint(uint64_t(x));
    points[6u * id + 1u] = uint(uint64_t(x) >> 32);
    points[6u * id + 2u] = uint(uint64_t(y));
    points[6u * id + 3u] = uint(uint64_t(y) >> 32);
    points[6u * id + 4u] = uint(uint64_t(z));
    points[6u * id + 5u] = uint(uint64_t(z) >> 32);
}

// floor(2^32 num / den) for 0 <= num <= den, below 2^126; 2^32 where they are equal.
uint64_t fractionOf(Wide128 num, Wide128 den) {
    uint64_t q = uint64_t(0);
    bool one = !wideLess(num, den);
    if (one) {
        q = uint64_t(1);
        num = wideSub(num, den);
    }
    for (uint k = 0u; k < ROLLED(32); k++) {
        num = wideDouble(num);
        bool take = !wideLess(num, den);
        if (take) num = wideSub(num, den);
        q = (q << 1) | (take ? uint64_t(1) : uint64_t(0));
    }
    return q;
}

// a + t (b - a) with t in units of 2^-32.
int64_t fixedBetween(int a, int b, uint64_t t) {
    return (int64_t(a) << POINT_FRACTION_BITS) + ((int64_t(b - a) * int64_t(t)) >> 8);
}

float fractionToFloat(uint64_t t) { return float(uint(t >> 8)) * (1.0 / 16777216.0); }
