// Every operation of lib/wide.glsl on one set of operands a lane.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/wide.glsl"

struct Operands {
    int64_t a, b;   // up to 53 bits
    Wide128 x, y;   // up to 95 bits
    int64_t factor; // up to 30 bits
    int64_t pad;
};

struct Results {
    Wide128 product, unsigned_product, scaled, sum, difference, negated, doubled, shifted, minor;
    Wide192 long_product, long_sum;
    int64_t signs; // of x, of the long product, and x < y
};

FLAT_KERNEL;
READS(0, Operands, operands);
WRITES(1, Results, results);
layout(push_constant) uniform Push { uint length; };

void main() {
    uint k = flatIndex();
    if (k >= length) return;
    Operands o = operands[k];
    Results r;
    r.product = wideMul(o.a, o.b);
    r.unsigned_product = wideMulUnsigned(o.x.lo, o.y.lo);
    r.scaled = wideScale(o.x, o.factor);
    r.sum = wideAdd(o.x, o.y);
    r.difference = wideSub(o.x, o.y);
    r.negated = wideNegate(o.x);
    r.doubled = wideDouble(o.x);
    r.shifted = wideShiftLeft25(o.x);
    r.minor = wideMinor(o.a, o.b, o.b, o.factor);
    r.long_product = wideMul192(o.x, o.y);
    r.long_sum = wideAdd(r.long_product, wideMul192(o.y, wideFrom(o.a)));
    r.signs = int64_t(wideSign(o.x)) + 10 * int64_t(wideSign(r.long_product)) + 100 * int64_t(wideLess(o.x, o.y) ? 1 : 0);
    results[k] = r;
}
