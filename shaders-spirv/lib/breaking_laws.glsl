// What a blow does to a body, as modules/brittle/effects has it (material.h says why and where from), in 32 bits. SI units.
#include "shared/material.h"
#include "lib/hash.glsl"

struct BodyForm {
    float volume;
    float surface;
    float side; // of the square plate that has both
    float thickness;
    float outline; // of a plate, in sides: a square's
    float crowded; // of a plate, how much crack a blow leaves in it for a square's (lib/plate_shape.glsl)
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
    return BodyForm(volume, surface, round_ ? edge : side, round_ ? edge : min(side, volume / (side * side)), 4.0, 1.0);
}

bool isThin(BodyForm form) { return float(THIN) * form.thickness < form.side; }

// How often the paper's pattern takes the candidate nearest to a blow (modules/brittle/fracture/pattern.h).
float favorOf(float joules) { return 1.0 - exp2(-joules); }

// The paper's sites lie about the middle as well: a plate that is hit beside it has them in two places, and as much crack as if the
// nearest candidate were taken less often. `off`: how far from the middle, of its side. Measured in worlds.
const float kPaperOff = 0.5, kPaperAside = 0.3;
float favorInPlate(float joules, float off) { return favorOf(joules) * (1.0 - kPaperOff * min(off / kPaperAside, 1.0)); }

float crowdingOf(float few, float more, float count) { return few + more * inversesqrt(count); }
float paperCrowdingOf(float first, float falls, float most, float count, float favor) { return 1.0 - favor * (1.0 - min(most, first * pow(count, -falls))); }

float crowdingInSolid(float count, uint spread, float favor) {
    if (spread == SPREAD_PAPER) return paperCrowdingOf(float(PAPER_IN_SOLID), float(PAPER_IN_SOLID_FALLS), float(PAPER_IN_SOLID_MOST), count, favor);
    return spread == SPREAD_EVEN ? 1.0 : crowdingOf(float(BLOW_IN_SOLID), float(BLOW_IN_SOLID_MORE), count);
}

float crowdingInPlate(float count, uint spread, float favor) {
    if (spread == SPREAD_PAPER) return paperCrowdingOf(float(PAPER_IN_PLATE), float(PAPER_IN_PLATE_FALLS), float(PAPER_IN_PLATE_MOST), count, favor);
    return spread == SPREAD_EVEN ? 1.0 : crowdingOf(float(BLOW_IN_PLATE), float(BLOW_IN_PLATE_MORE), count);
}

float cracksOfSolid(BodyForm form, float count, uint spread, float favor) {
    float edge = pow(form.volume, 1.0 / 3.0), rim = 1.0 - 1.0 / count, bulk = 0.5 * float(CELL_SURFACE) * edge * edge * (pow(count, 1.0 / 3.0) - 1.0 / count);
    return crowdingInSolid(count, spread, favor) * bulk - float(SOLID_RIM) * max(form.surface, 6.0 * edge * edge) * rim;
}

float cracksOfPlate(BodyForm form, float count, uint spread, float favor) {
    float wall = form.side * form.thickness, rim = 1.0 - 1.0 / count;
    float bulk = form.crowded * 0.5 * float(CELL_OUTLINE) * wall * (sqrt(count) - 1.0 / count);
    return crowdingInPlate(count, spread, favor) * bulk - form.outline * float(PLATE_RIM) * wall * rim;
}

float crackAreaOf(BodyForm form, float count, uint spread, float favor) {
    if (count <= 1.0) return 0.0;
    float wide = form.side / form.thickness, most = wide * wide;
    if (!isThin(form)) return max(cracksOfSolid(form, count, spread, favor), 0.0);
    float plate = cracksOfPlate(form, min(count, most), spread, favor);
    return count <= most ? plate : max(plate, cracksOfSolid(form, count, spread, favor));
}

// crackAreaOf grows with the count: the most that can be paid for, between 1 and 2^24, by halving.
float expectedFragments(MaterialCard card, BodyForm form, float joules, uint spread, float favor) {
    float area = card.cracks.z * joules / card.cracks.y, low = 0.0, high = 24.0;
    for (uint k = 0u; k < 28u; k++) {
        float middle = 0.5 * (low + high);
        bool paid = crackAreaOf(form, exp2(middle), spread, favor) <= area;
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
uint fragmentCount(MaterialCard card, BodyForm form, float joules, uint budget, float chance, uint spread, float favor) {
    return uint(min(min(floor(expectedFragments(card, form, joules, spread, favor) + chance), roomForFragments(card, form)), float(budget)));
}

// Whether the energy pays for two fragments, for which there is room.
bool paysForTwo(MaterialCard card, BodyForm form, float joules, uint spread) {
    return card.cracks.z * joules >= card.cracks.y * crackAreaOf(form, 2.0, spread, favorOf(joules)) && roomForFragments(card, form) >= 2.0;
}

// The chance is that of the object, bit for bit the host's.
float chanceOf(uint seed_low, uint seed_high, uint object) {
    uint hash = mixed(mixed(mixed(seed_low + 0x9e3779b9u) ^ seed_high) + object * 0x85ebca6bu);
    return (float(hash >> CHANCE_SHIFT) + 0.5) * CHANCE_STEP;
}

// -log(chance); near 1, where a logarithm in fp32 has few digits left, its series.
float hazardOf(float chance) {
    float x = 1.0 - chance;
    return x < 0.0625 ? x * (1.0 + x * (0.5 + x * (1.0 / 3.0 + x * (0.25 + x * (0.2 + x / 6.0))))) : -log(chance);
}

float strengthOf(MaterialCard card, float volume, float chance) {
    return card.elastic.w * pow(hazardOf(chance) / volume, card.cracks.x);
}

float impactStress(MaterialCard card, BodyForm form, Blow blow) {
    float thin = form.thickness / form.side, gain = sqrt(1.0 + (float(BENDING_GAIN_SQUARED) - 1.0) * (1.0 - thin * thin));
    return gain * card.elastic.z / (1.0 + card.elastic.z / blow.other_impedance) * blow.speed;
}

bool breaks(MaterialCard card, BodyForm form, float strength, Blow blow, uint spread) {
    return impactStress(card, form, blow) >= strength && paysForTwo(card, form, energyOf(blow), spread);
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
