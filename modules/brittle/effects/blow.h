// What a blow does to a body: whether it breaks, what cracks may take, and where (effects/material.h has the laws). Pure
// functions.
//
// A blow is what is known of a contact before it is solved: the mass that meets, 1 / (1/m1 + 1/m2 and what turning gives way),
// and the speed at which the two bodies come together along the normal. Neither depends on the length of a step.
//
// Kernels do the same in 32 bits; chances are the same there bit for bit, since they come from integers.
#pragma once

#include "modules/brittle/effects/fragment_count.h"

#include <cstdint>

namespace brittle {

struct Blow {
    double mass = 0;                          // kg, effective, above 0
    double speed = 0;                         // m/s, at least 0
    double other_impedance = RIGID_IMPEDANCE; // Pa s/m, of what it is hit by; the default gives way to nothing
};

// J: mass speed^2 / 2, all that the two bodies can lose along the normal.
double energyOf(const Blow& blow);

// A number between 0 and 1, never either of them: evenly distributed over objects and seeds, always the same for one.
double chanceOf(uint64_t seed, uint32_t object);

// Pa: the stress at which this very body breaks, if `chance` is its own. Volume above 0, chance between 0 and 1.
double strengthOf(const Material& material, double volume, double chance);

// From 1, for what is as thick as wide, to sqrt(3), for what is thin: 1 + 2 (1 - (thickness / side)^2) under the root. The ends
// are Hunt's; what lies between is chosen.
double bendingGainOf(const BodyForm& form);

// Pa: the most stress that the blow makes in the body. That it grows where the contact is small is left out: there it crushes.
double impactStress(const Material& material, const BodyForm& form, const Blow& blow);

// Where the stress is no less than the strength, and the energy pays for two fragments for which there is room.
bool breaks(const Material& material, const BodyForm& form, double strength, const Blow& blow,
            Spread spread = Spread::AboutBlow);

// m2 of crack that is paid for: eta E / G_c. Joules at least 0.
double affordedCracks(const Material& material, double joules);
// J that so many m2 of crack take, each counted once: G_c times area.
double crackEnergyOf(const Material& material, double area);

// N s along the normal, to hold the bodies off each other with, which takes exactly `joules` from their motion:
// mass (v - sqrt(v^2 - 2 joules / mass)), written without a difference. It never turns them back: more energy than they have is
// all that they have. Joules at least 0.
double crackImpulse(const Blow& blow, double joules);

// Pa, of two bodies: 1 / (1 / a + 1 / b). RIGID_MODULUS gives way to nothing.
double sharedModulusOf(double contact_modulus_a, double contact_modulus_b);
// m, of the contact when it is largest: sqrt(R d), d = (15 m v^2 / (16 sqrt(R) E))^(2/5) (Hertz 1882; Johnson, Contact
// Mechanics, 1985, 11.4). `curvature_radius` R: 1 / (1 / R1 + 1 / R2), m, above 0. Right while both are slower than their
// waves.
double hertzRadiusOf(const Blow& blow, double curvature_radius, double shared_modulus);

} // namespace brittle
