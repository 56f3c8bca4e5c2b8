// What bodies are made of, as far as breaking goes: cards of measured values, in SI units.
//
// The laws that ask for them, in the order in which a blow goes through them:
//
// Stress (blow.h). Two bodies that meet at the speed v press each other, until waves have come back from their far sides, with
// Z1 Z2 / (Z1 + Z2) v, where Z = density * wave speed (Goldsmith, Impact, 1960; Kolsky, Stress Waves in Solids, 1953: bars that
// meet end to end). It is reflected as tension, which is what brittle things break of. Thin bodies bend under it, and bending
// makes it larger, by sqrt(3) where the section is a rectangle (Hunt, Stress and strain limits on the attainable velocity in
// mechanical vibration, 1960).
//
// Strength (blow.h). What is brittle breaks at its worst flaw, and so no two bodies are equally strong, and large ones are
// weaker (Weibull, A statistical theory of the strength of materials, 1939): a body of the volume V survives the stress s with
// the probability exp(-(V / V0) (s / s0)^m). Hence its own strength is s0 (V0 / V)^(1/m) (-ln u)^(1/m), with u drawn evenly.
//
// Count (fragment_count.h). New surface costs energy (Griffith, The phenomena of rupture and flow in solids, 1921): G_c for
// each square meter of crack, which has two sides. A share eta of the blow's energy goes there; the rest goes into motion,
// sound and heat, and there is no law for how much, so it is the one dial. Cells of N random sites have together a surface of
// 5.821 V^(2/3) N^(1/3) (Meijering, Interface area, edge length, and number of vertices in crystal aggregates, 1953), half of
// which is saved as each cut serves two. Where sites crowd there is less of it, and at the rim; fragment_count.h has how much.
// That gives N.
//
// Ledger (blow.h). What cracks take is missing from the motion of the two bodies that met, and nothing else is.
//
// Place (blow.h). The contact has grown to the radius of Hertz (On the contact of elastic solids, 1882) when it presses most;
// within it cells are smallest. Outside, what a blow strains spreads over half spheres, and falls as r^-2; in what is thin over
// rings, and falls as 1/r. Fragments of what is strained at the rate e are as large as e^(-2/3) (Grady, Local inertial effects
// in dynamic fragmentation, 1982): r^(4/3) and r^(2/3). So their sites are as dense as r^-4 in space, and as r^(-4/3) in a
// plane. In a solid that alone would leave most of it in one piece, which the stress that broke it has gone through as well, as
// waves that come back: half of the sites lie about the blow, and half evenly. The half is chosen.
#pragma once

#include "shaders-spirv/shared/material.h"

#include <span>
#include <string>
#include <string_view>

namespace brittle {

struct Material {
    std::string name;
    double density = 0;          // kg/m3
    double youngs_modulus = 0;   // Pa
    double poisson_ratio = 0;    // at least 0, less than 0.5
    double fracture_energy = 0;  // G_c, J/m2 of crack
    double tensile_strength = 0; // Pa, which 37 of 100 bodies of the reference volume have: Weibull's scale
    double weibull_modulus = 0;  // at least 1: how alike bodies are
    double reference_volume = 0; // m3
    double eta = 0;              // 0 to 1: share of a blow's energy that goes into cracks
    double smallest_cell = 0;    // m; what would be smaller is not worth keeping
    bool operator==(const Material&) const = default;
};

// Glass (annealed), porcelain, concrete, brick, ice, stone (granite). Where each value comes from stands next to it in
// material.cpp. Tempered glass is not among them: it breaks by the stress that it holds, not by a blow.
std::span<const Material> builtinMaterials();
// The built-in card of that name, nullptr where there is none.
const Material* findMaterial(std::string_view name);

// J/m2, of a toughness in Pa sqrt(m): K^2 (1 - nu^2) / E (Irwin, Analysis of stresses and strains near the end of a crack
// traversing a plate, 1957), in plane strain.
double fractureEnergyOf(double toughness, double youngs_modulus, double poisson_ratio);

// m/s: sqrt(E / density), of waves along a bar. Contacts are small, and what is pressed gives way sideways, as a bar does.
double waveSpeedOf(const Material& material);
// Pa s/m: density times wave speed.
double impedanceOf(const Material& material);
// Pa: E / (1 - nu^2), of what is pressed in one place.
double contactModulusOf(const Material& material);

// As kernels read it. Values are rounded to 32 bits, nothing else.
gpu::MaterialCard cardOf(const Material& material);

} // namespace brittle
