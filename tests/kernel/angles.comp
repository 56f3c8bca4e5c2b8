// sineAndCosine of lib/trigonometry.glsl.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/trigonometry.glsl"

FLAT_KERNEL;
READS(0, float, angles);
WRITES(1, vec2, results);
layout(push_constant) uniform Push { uint length; };

void main() {
    uint k = flatIndex();
    if (k >= length) return;
    results[k] = sineAndCosine(angles[k]);
}
