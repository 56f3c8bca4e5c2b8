#include "modules/brittle/effects/blow.h"

#include <algorithm>
#include <cmath>

namespace brittle {
namespace {

// The kernels' own hash, so that there is one.
using uint = uint32_t;
#include "shaders-spirv/lib/hash.glsl"

} // namespace

double energyOf(const Blow& blow) { return blow.mass * blow.speed * blow.speed / 2; }

double chanceOf(uint64_t seed, uint32_t object) {
    const auto low = static_cast<uint32_t>(seed), high = static_cast<uint32_t>(seed >> 32);
    const uint32_t hash = mixed(mixed(mixed(low + 0x9e3779b9u) ^ high) + object * 0x85ebca6bu);
    return ((hash >> CHANCE_SHIFT) + 0.5) * CHANCE_STEP;
}

double strengthOf(const Material& material, double volume, double chance) {
    return material.tensile_strength *
           std::pow(-std::log(chance) * material.reference_volume / volume, 1 / material.weibull_modulus);
}

double bendingGainOf(const BodyForm& form) {
    const double thickness = form.thickness / form.side;
    return std::sqrt(1 + (BENDING_GAIN_SQUARED - 1) * (1 - thickness * thickness));
}

double impactStress(const Material& material, const BodyForm& form, const Blow& blow) {
    const double impedance = impedanceOf(material);
    return bendingGainOf(form) * impedance / (1 + impedance / blow.other_impedance) * blow.speed;
}

bool breaks(const Material& material, const BodyForm& form, double strength, const Blow& blow, Spread spread) {
    const double needed = energyForFragments(material, form, 2, spread);
    const bool pays = needed <= energyOf(blow) && roomForFragments(material, form) >= 2;
    return pays && impactStress(material, form, blow) >= strength;
}

double affordedCracks(const Material& material, double joules) { return material.eta * joules / material.fracture_energy; }
double crackEnergyOf(const Material& material, double area) { return material.fracture_energy * area; }

double crackImpulse(const Blow& blow, double joules) {
    if (joules <= 0) return 0;
    const double left = std::max(0.0, blow.speed * blow.speed - 2 * joules / blow.mass);
    const double taken = std::min(joules, energyOf(blow));
    return taken > 0 ? 2 * taken / (blow.speed + std::sqrt(left)) : 0;
}

double sharedModulusOf(double contact_modulus_a, double contact_modulus_b) {
    return contact_modulus_a / (1 + contact_modulus_a / contact_modulus_b);
}

double hertzRadiusOf(const Blow& blow, double curvature_radius, double shared_modulus) {
    const double push = blow.mass * blow.speed * blow.speed / (std::sqrt(curvature_radius) * shared_modulus);
    return std::sqrt(curvature_radius * std::pow(HERTZ_APPROACH * push, 0.4));
}

} // namespace brittle
