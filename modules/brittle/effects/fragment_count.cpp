#include "modules/brittle/effects/fragment_count.h"

#include "modules/brittle/fracture/pattern.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brittle {
namespace {

constexpr double kMost = 1 << 24;

double squared(double x) { return x * x; }

// Cells that are as wide as the plate is thick: the plate's law holds for no more.
double mostInPlate(const BodyForm& form) { return squared(form.side / form.thickness); }

struct Crowding {
    double few, more;          // about the blow
    double first, falls, most; // of the paper's
};
constexpr Crowding kInSolid = {BLOW_IN_SOLID, BLOW_IN_SOLID_MORE, PAPER_IN_SOLID, PAPER_IN_SOLID_FALLS, PAPER_IN_SOLID_MOST};
constexpr Crowding kInPlate = {BLOW_IN_PLATE, BLOW_IN_PLATE_MORE, PAPER_IN_PLATE, PAPER_IN_PLATE_FALLS, PAPER_IN_PLATE_MOST};

double crowdingOf(const Crowding& of, double count, Spread spread, double favor) {
    if (spread == Spread::Even) return 1;
    if (spread == Spread::AboutBlow) return of.few + of.more / std::sqrt(count);
    return 1 - favor * (1 - std::min(of.most, of.first * std::pow(count, -of.falls)));
}

double cracksOfSolid(const BodyForm& form, double count, Spread spread, double favor) {
    const double square = squared(std::cbrt(form.volume));
    const double bulk = CELL_SURFACE / 2 * square * (std::cbrt(count) - 1 / count);
    const double rim = SOLID_RIM * std::max(form.surface, 6 * square) * (1 - 1 / count);
    return crowdingOf(kInSolid, count, spread, favor) * bulk - rim;
}

double cracksOfPlate(const BodyForm& form, double count, Spread spread, double favor) {
    const double wall = form.side * form.thickness;
    const double bulk = CELL_OUTLINE / 2 * wall * (std::sqrt(count) - 1 / count);
    return crowdingOf(kInPlate, count, spread, favor) * bulk - PLATE_RIM * 4 * wall * (1 - 1 / count);
}

} // namespace

// side^3 - surface/2 side + 2 volume = 0 has, for what is no rounder than a cube, three real roots (Viete); the largest one is
// the plate, another one a rod.
BodyForm formOf(double volume, double surface) {
    const double cosine = -6 * volume / surface * std::sqrt(6 / surface);
    if (cosine <= -1) return {volume, surface, std::cbrt(volume), std::cbrt(volume)};
    const double side = 2 * std::sqrt(surface / 6) * std::cos(std::acos(cosine) / 3);
    return {volume, surface, side, std::min(side, volume / squared(side))};
}

bool isThin(const BodyForm& form) { return THIN * form.thickness < form.side; }

double crackAreaOf(const BodyForm& form, double count, Spread spread, double favor) {
    if (count <= 1) return 0;
    if (!isThin(form)) return std::max(0.0, cracksOfSolid(form, count, spread, favor));
    const double plate = cracksOfPlate(form, std::min(count, mostInPlate(form)), spread, favor);
    return count <= mostInPlate(form) ? plate : std::max(plate, cracksOfSolid(form, count, spread, favor));
}

// By halving: the law has no inverse that could be written down.
double expectedFragments(const Material& material, const BodyForm& form, double joules, Spread spread) {
    const double area = material.eta * joules / material.fracture_energy;
    const double favor = favorOf(joules);
    double low = 0, high = std::log2(kMost);
    for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        (crackAreaOf(form, std::exp2(middle), spread, favor) <= area ? low : high) = middle;
    }
    return std::exp2(low);
}

double roomForFragments(const Material& material, const BodyForm& form) {
    const double across = form.side / material.smallest_cell, deep = form.thickness / material.smallest_cell;
    return std::max(1.0, squared(across) * std::max(1.0, deep));
}

uint32_t fragmentCount(const Material& material, const BodyForm& form, double joules, uint32_t budget, double chance,
                       Spread spread) {
    const double most = budget == 0 ? std::numeric_limits<uint32_t>::max() : budget;
    const double count = std::floor(expectedFragments(material, form, joules, spread) + chance);
    return static_cast<uint32_t>(std::min({count, std::floor(roomForFragments(material, form)), most}));
}

// How crowded the paper's sites are depends on the energy, which decides by halving.
double energyForFragments(const Material& material, const BodyForm& form, double count, Spread spread) {
    const auto costs = [&](double favor) {
        return material.fracture_energy * crackAreaOf(form, count, spread, favor) / material.eta;
    };
    if (!(costs(0) > 0)) return 0;
    if (spread != Spread::Paper || material.eta == 0) return costs(0);
    double low = 0, high = costs(0);
    for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        (middle < costs(favorOf(middle)) ? low : high) = middle;
    }
    return high;
}

} // namespace brittle
