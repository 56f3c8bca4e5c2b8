// Chances and strengths of bodies, as strengthOf and chanceOf of modules/brittle/effects/blow.h have them.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/breaking_laws.glsl"

FLAT_KERNEL;
READS(0, MaterialCard, cards);
WRITES(1, vec2, strengths); // chance, strength
layout(push_constant) uniform Push {
    uint length;
    uint seed_low;
    uint seed_high;
    float volume;
};

void main() {
    uint k = flatIndex();
    if (k >= length) return;
    float chance = chanceOf(seed_low, seed_high, k);
    strengths[k] = vec2(chance, strengthOf(cards[0], volume, chance));
}
