#include "modules/brittle/effects/material.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace brittle {
namespace {

// Weibull's scale of strengths that are as a mean: the mean is scale * Gamma(1 + 1/m).
double scaleOfMean(double mean, double modulus) { return mean / std::tgamma(1 + 1 / modulus); }
// The same of a strength that all but a share of the bodies have.
double scaleOfShare(double strength, double weaker, double modulus) {
    return strength * std::pow(-std::log1p(-weaker), -1 / modulus);
}

// "Chosen" is said of what no source fixes: shares of energy, sizes of cells, and what is said to be typical.

Material glass() {
    return {
        .name = "glass",
        .density = 2500,        // EN 572-1, soda lime silicate glass
        .youngs_modulus = 70e9, // EN 572-1
        .poisson_ratio = 0.2,   // EN 572-1
        // From K = 0.75 MPa sqrt(m) (Haldimann, Luible, Overend, Structural Use of Glass, 2008). Measured without water: 0.77
        // (Methods for determining the mode I and mode II fracture toughness of glass using thermal stresses, 1990).
        .fracture_energy = fractureEnergyOf(0.75e6, 70e9, 0.2),
        // From 45 MPa, which EN 572-1 says that all but 5 of 100 annealed panes have in bending.
        .tensile_strength = scaleOfShare(45e6, 0.05, 7),
        .weibull_modulus = 7, // ASTM E1300, the flaws of windows
        // What is bent most in the test of EN 1288-3: 0.2 m * 0.36 m between the inner rollers; of a pane of 6 mm (chosen).
        .reference_volume = 0.2 * 0.36 * 0.006,
        .eta = 0.05,            // chosen
        .smallest_cell = 0.002, // chosen
    };
}

Material porcelain() {
    return {
        .name = "porcelain",
        .density = 2380,        // of a body of kaolin, feldspar and quartz: see tensile_strength
        .youngs_modulus = 70e9, // chosen; IEC 60672-3 wants at least 60 GPa of porcelain C 110
        .poisson_ratio = 0.2,   // chosen
        // From K = 1.2 MPa sqrt(m), which is chosen: of dental porcelains 0.7 to 1.1 are measured and 1.5 to 2.1 reported
        // (paper 1212 of the 13th International Conference on Fracture, 2013).
        .fracture_energy = fractureEnergyOf(1.2e6, 70e9, 0.2),
        // 900 kgf/cm2 in bending, with coarse grains of quartz among fine ones ("Effect of coarse quartz grains on mechanical
        // strength of porcelain body"); C 110 has to have 50 MPa.
        .tensile_strength = 88e6,
        .weibull_modulus = 10,    // chosen
        .reference_volume = 1e-5, // chosen: a rod for bending, 1 cm wide and 12 cm long
        .eta = 0.05,              // chosen
        .smallest_cell = 0.002,   // chosen
    };
}

// C30/37, whose mean strength in compression is 38 MPa, with grains of up to 16 mm.
Material concrete() {
    return {
        .name = "concrete",
        .density = 2400,        // EN 206: normal concrete has 2000 to 2600 kg/m3
        .youngs_modulus = 33e9, // EN 1992-1-1, table 3.1
        .poisson_ratio = 0.2,   // EN 1992-1-1, 3.1.3
        // CEB-FIP Model Code 1990: 30 J/m2 * (38 MPa / 10 MPa)^0.7. Not from a toughness: cracks in concrete have no sharp tip.
        .fracture_energy = 30 * std::pow(3.8, 0.7),
        .tensile_strength = scaleOfMean(2.9e6, 12), // EN 1992-1-1, table 3.1, a mean
        .weibull_modulus = 12,      // Zech and Wittmann 1977, by Bazant and Novak 2000, who have 24 of large beams
        .reference_volume = 0.0053, // the cylinder of EN 12390-1, 15 cm wide and 30 cm high
        .eta = 0.1,                 // chosen
        .smallest_cell = 0.01,      // chosen: a grain
    };
}

Material brick() {
    return {
        .name = "brick",
        .density = 1900,          // chosen: fired clay without holes
        .youngs_modulus = 16.7e9, // Lourenco, Computational strategies for masonry structures, 1996: walls tested in Eindhoven
        .poisson_ratio = 0.15,    // the same
        // The middle of 47.4 and 58.2 (Mohammed, Hughes, Danraka, Fracture energy of full scale and half scale masonry bricks).
        .fracture_energy = 53,
        // The middle of 1.5 to 3.5 MPa (van der Pluijm 1992, by Lourenco 1996), taken as a mean.
        .tensile_strength = scaleOfMean(2.5e6, 10),
        .weibull_modulus = 10,                 // chosen: less alike than concrete
        .reference_volume = 0.21 * 0.1 * 0.05, // chosen: a brick
        .eta = 0.1,                            // chosen
        .smallest_cell = 0.005,                // chosen
    };
}

Material ice() {
    return {
        .name = "ice",
        .density = 917,           // CRC Handbook of Chemistry and Physics, at 0 C
        .youngs_modulus = 9.33e9, // Gammon, Kiefte, Clouter, Denner, Elastic constants of artificial and natural ice samples,
        .poisson_ratio = 0.325,   // 1983: many crystals, -16 C
        // From K = 0.1 MPa sqrt(m), the middle of 0.05 to 0.15 (Petrovic, Mechanical properties of ice and snow, 2003).
        .fracture_energy = fractureEnergyOf(0.1e6, 9.33e9, 0.325),
        .tensile_strength = scaleOfMean(1.9e6, 5), // the middle of 0.7 to 3.1 MPa (Petrovic 2003), taken as a mean
        .weibull_modulus = 5,                      // Petrovic 2003
        .reference_volume = 0.001,                 // chosen: a cylinder, 8 cm wide and 20 cm long
        .eta = 0.05,                               // chosen
        .smallest_cell = 0.005,                    // chosen
    };
}

// Granite.
Material stone() {
    return {
        .name = "stone",
        .density = 2700,        // EN 1991-1-1, annex A: 27 to 30 kN/m3
        .youngs_modulus = 50e9, // of 30 to 60 GPa (National Research Council, Conservation of Historic Stone Buildings, 1982)
        .poisson_ratio = 0.25,  // chosen
        // From K = 1.5 MPa sqrt(m), chosen from what granites have (Atkinson and Meredith, Experimental fracture mechanics data
        // for rocks and minerals, 1987).
        .fracture_energy = fractureEnergyOf(1.5e6, 50e9, 0.25),
        .tensile_strength = 10e6, // the least of 10 to 70 MPa in bending (National Research Council 1982)
        .weibull_modulus = 12,    // chosen: as concrete
        // The disk of the Brazilian test (International Society for Rock Mechanics 1978), 54 mm wide, half as thick.
        .reference_volume = 6.2e-5,
        .eta = 0.05,            // chosen
        .smallest_cell = 0.005, // chosen
    };
}

} // namespace

std::span<const Material> builtinMaterials() {
    static const std::array<Material, 6> kCards = {glass(), porcelain(), concrete(), brick(), ice(), stone()};
    return kCards;
}

const Material* findMaterial(std::string_view name) {
    const auto cards = builtinMaterials();
    const auto found = std::find_if(cards.begin(), cards.end(), [&](const Material& card) { return card.name == name; });
    return found == cards.end() ? nullptr : &*found;
}

double fractureEnergyOf(double toughness, double youngs_modulus, double poisson_ratio) {
    return toughness * toughness * (1 - poisson_ratio * poisson_ratio) / youngs_modulus;
}

double waveSpeedOf(const Material& material) { return std::sqrt(material.youngs_modulus / material.density); }
double impedanceOf(const Material& material) { return std::sqrt(material.youngs_modulus * material.density); }
double contactModulusOf(const Material& material) {
    return material.youngs_modulus / (1 - material.poisson_ratio * material.poisson_ratio);
}

gpu::MaterialCard cardOf(const Material& material) {
    const double share = 1 / material.weibull_modulus;
    const double of_cubic_meter = material.tensile_strength * std::pow(material.reference_volume, share);
    return {.elastic = {static_cast<float>(material.density), static_cast<float>(contactModulusOf(material)),
                        static_cast<float>(impedanceOf(material)), static_cast<float>(of_cubic_meter)},
            .cracks = {static_cast<float>(share), static_cast<float>(material.fracture_energy),
                       static_cast<float>(material.eta), static_cast<float>(material.smallest_cell)}};
}

} // namespace brittle
