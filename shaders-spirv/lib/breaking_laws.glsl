// What a blow does to a body, as modules/brittle/effects has it (material.h says why and where from), in 32 bits. SI units.
#include "shared/material.h"
#include "lib/hash.glsl"

struct BodyForm {
    float volume;
    float surface;
    float side; // of the square plate that has both
    float thickness;
};

struct Blow {
    float mass;
    float speed;
    float other_impedance;
};

float energyOf(Blow blow) { return 0.5 * blow.mass * blow.speed * blow.speed; }

// side^3 - surface/2 side + 2 volume = 0: the largest of three roots (Viete). In thin bodies the cosine is next to nothing.
BodyForm formOf(float volume, float surface) {
    float cosine = -6.0 * volume / surface * sqrt(6.0 / surface), edge = pow(volume, 1.0 / 3.0);
    float side = 2.0 * sqrt(surface / 6.0) * cos(acos(max(cosine, -1.0)) / 3.0);
    bool round_ = cosine <= -1.0;
    return BodyForm(volume, surface, round_ ? edge : side, round_ ? edge : min(side, volume / (side * side)));
}

float cubed(float x) { return x * x * x; }

float expectedFragments(MaterialCard card, BodyForm form, float joules) {
    float made = 2.0 * card.cracks.z * joules / card.cracks.y, edge = pow(form.volume, 1.0 / 3.0);
    bool is_plate = form.thickness < form.side && made + form.surface < 6.0 * form.side * form.side;
    float plate = (made / form.thickness + float(CELL_OUTLINE) * form.side) / (float(CELL_OUTLINE) * form.side);
    float solid = cubed((made + form.surface) / (float(CELL_SURFACE) * edge * edge));
    return max(1.0, is_plate ? plate * plate : solid);
}

float roomForFragments(MaterialCard card, BodyForm form) {
    float across = form.side / card.cracks.w, deep = form.thickness / card.cracks.w;
    return max(1.0, across * across * max(1.0, deep));
}

uint fragmentCount(MaterialCard card, BodyForm form, float joules, uint budget) {
    return uint(min(min(expectedFragments(card, form, joules), roomForFragments(card, form)), float(budget)));
}

// The chance is that of the object, bit for bit the host's.
float chanceOf(uint seed_low, uint seed_high, uint object) {
    uint hash = mixed(mixed(mixed(seed_low + 0x9e3779b9u) ^ seed_high) + object * 0x85ebca6bu);
    return (float(hash >> CHANCE_SHIFT) + 0.5) * CHANCE_STEP;
}

float strengthOf(MaterialCard card, float volume, float chance) {
    return card.elastic.w * pow(-log(chance) / volume, card.cracks.x);
}

float impactStress(MaterialCard card, BodyForm form, Blow blow) {
    float thin = form.thickness / form.side, gain = sqrt(1.0 + (float(BENDING_GAIN_SQUARED) - 1.0) * (1.0 - thin * thin));
    return gain * card.elastic.z / (1.0 + card.elastic.z / blow.other_impedance) * blow.speed;
}

bool breaks(MaterialCard card, BodyForm form, float strength, Blow blow) {
    return impactStress(card, form, blow) >= strength && fragmentCount(card, form, energyOf(blow), 0xffffffu) >= 2u;
}

// N s, which takes so much energy from the motion of both and never turns them back.
float crackImpulse(Blow blow, float joules) {
    float left = max(0.0, blow.speed * blow.speed - 2.0 * joules / blow.mass), taken = min(joules, energyOf(blow));
    return taken > 0.0 ? 2.0 * taken / (blow.speed + sqrt(left)) : 0.0;
}

float hertzRadiusOf(Blow blow, float curvature_radius, float shared_modulus) {
    float pressed = blow.mass * blow.speed * blow.speed / (sqrt(curvature_radius) * shared_modulus);
    return sqrt(curvature_radius * pow(float(HERTZ_APPROACH) * pressed, 0.4));
}
