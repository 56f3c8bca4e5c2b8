// fractionOf of lib/place.glsl.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

struct Ratio {
    uint64_t num_lo;
    int64_t num_hi;
    uint64_t den_lo;
    int64_t den_hi;
};

FLAT_KERNEL;
READS(0, Ratio, ratios);
WRITES(1, uint64_t, fractions);
UPDATES(2, uint, points);
layout(push_constant) uniform Push { uint length; };
#include "lib/place.glsl"

void main() {
    uint k = flatIndex();
    if (k >= length) return;
    Ratio r = ratios[k];
    fractions[k] = fractionOf(Wide128(r.num_lo, r.num_hi), Wide128(r.den_lo, r.den_hi));
    savePoint(k, fixedBetween(3, 5, fractions[k]), fixedBetween(5, 3, fractions[k]), int64_t(-1));
}
