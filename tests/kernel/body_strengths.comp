// Chances and strengths of bodies, as strengthOf and chanceOf of modules/brittle/effects/blow.h have them.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/material.h"
#include "lib/hash.glsl"

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
    uint hash = mixed(mixed(mixed(seed_low + 0x9e3779b9u) ^ seed_high) + k * 0x85ebca6bu);
    float chance = (float(hash >> CHANCE_SHIFT) + 0.5) * CHANCE_STEP;
    strengths[k] = vec2(chance, cards[0].elastic.w * pow(-log(chance) / volume, cards[0].cracks.x));
}
