// The laws of breaking, one case a lane.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/breaking_laws.glsl"

FLAT_KERNEL;
READS(0, MaterialCard, cards);
READS(1, vec4, bodies); // volume, surface, chance, radius of curvature
READS(2, vec4, blows);  // mass, speed, impedance of the other, modulus of both
WRITES(3, vec4, laws);  // two each: fragments expected, room for them, stress, strength; impulse, radius, count, whether it breaks
layout(push_constant) uniform Push { uint length; };

void main() {
    uint k = flatIndex();
    if (k >= length) return;
    MaterialCard card = cards[k];
    BodyForm form = formOf(bodies[k].x, bodies[k].y);
    Blow blow = Blow(blows[k].x, blows[k].y, blows[k].z);
    float joules = energyOf(blow), strength = strengthOf(card, form.volume, bodies[k].z);
    laws[2u * k] = vec4(expectedFragments(card, form, joules, SPREAD_ABOUT_BLOW, 0.0), roomForFragments(card, form), impactStress(card, form, blow), strength);
    laws[2u * k + 1u] = vec4(crackImpulse(blow, card.cracks.z * joules), hertzRadiusOf(blow, bodies[k].w, blows[k].w),
                             float(fragmentCount(card, form, joules, 1000u, 0.0, SPREAD_ABOUT_BLOW, 0.0)), breaks(card, form, strength, blow, SPREAD_ABOUT_BLOW) ? 1.0 : 0.0);
}
