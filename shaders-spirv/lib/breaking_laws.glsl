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

bool isThin(BodyForm form) { return float(THIN) * form.thickness < form.side; }

float cracksOfSolid(BodyForm form, float count, bool even) {
    float edge = pow(form.volume, 1.0 / 3.0), rim = 1.0 - 1.0 / count;
    float crowded = even ? 1.0 : float(BLOW_IN_SOLID) + float(BLOW_IN_SOLID_MORE) * inversesqrt(count);
    return crowded * 0.5 * float(CELL_SURFACE) * edge * edge * (pow(count, 1.0 / 3.0) - 1.0 / count) - float(SOLID_RIM) * max(form.surface, 6.0 * edge * edge) * rim;
}

float cracksOfPlate(BodyForm form, float count, bool even) {
    float wall = form.side * form.thickness, rim = 1.0 - 1.0 / count, crowded = even ? 1.0 : float(BLOW_IN_PLATE) + float(BLOW_IN_PLATE_MORE) * inversesqrt(count);
    return crowded * 0.5 * float(CELL_OUTLINE) * wall * (sqrt(count) - 1.0 / count) - 4.0 * float(PLATE_RIM) * wall * rim;
}

float crackAreaOf(BodyForm form, float count, bool even) {
    if (count <= 1.0) return 0.0;
    float wide = form.side / form.thickness, most = wide * wide;
    if (!isThin(form)) return max(cracksOfSolid(form, count, even), 0.0);
    float plate = cracksOfPlate(form, min(count, most), even);
    return count <= most ? plate : max(plate, cracksOfSolid(form, count, even));
}

// crackAreaOf grows with the count: the most that can be paid for, between 1 and 2^24, by halving.
float expectedFragments(MaterialCard card, BodyForm form, float joules, bool even) {
    float area = card.cracks.z * joules / card.cracks.y, low = 0.0, high = 24.0;
    for (uint k = 0u; k < 28u; k++) {
        float middle = 0.5 * (low + high);
        bool paid = crackAreaOf(form, exp2(middle), even) <= area;
        low = paid ? middle : low;
        high = paid ? high : middle;
    }
    return exp2(low);
}

float roomForFragments(MaterialCard card, BodyForm form) {
    float across = form.side / card.cracks.w, deep = form.thickness / card.cracks.w;
    return max(1.0, across * across * max(1.0, deep));
}

// To the next whole number below or above, more often to the nearer one: a chance of 0 rounds down.
uint fragmentCount(MaterialCard card, BodyForm form, float joules, uint budget, float chance, bool even) {
    return uint(min(min(floor(expectedFragments(card, form, joules, even) + chance), roomForFragments(card, form)), float(budget)));
}

// Whether the energy pays for two fragments, for which there is room.
bool paysForTwo(MaterialCard card, BodyForm form, float joules, bool even) {
    return card.cracks.z * joules >= card.cracks.y * crackAreaOf(form, 2.0, even) && roomForFragments(card, form) >= 2.0;
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

bool breaks(MaterialCard card, BodyForm form, float strength, Blow blow, bool even) {
    return impactStress(card, form, blow) >= strength && paysForTwo(card, form, energyOf(blow), even);
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
