#include "modules/brittle/effects/fragment_count.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brittle {
namespace {

// m2 of surface that so much energy makes: a crack has two sides.
double newSurfaceOf(const Material& material, double joules) { return 2 * material.eta * joules / material.fracture_energy; }

double squared(double x) { return x * x; }

// Cells that are as wide as the plate is thick: the plate's law holds for no more.
double mostInPlate(const BodyForm& form) { return squared(form.side / form.thickness); }

// The surface that a body has once it is broken, at which the solid's law takes over; the plate's law has come to mostInPlate.
double surfaceAtSwitch(const BodyForm& form) { return 6 * squared(form.side); }

bool isPlate(const BodyForm& form, double all_surface) {
    return form.thickness < form.side && all_surface < surfaceAtSwitch(form);
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

double solidFragments(const Material& material, double joules, double volume, double surface) {
    const double ratio = (newSurfaceOf(material, joules) + surface) / (CELL_SURFACE * squared(std::cbrt(volume)));
    return ratio * ratio * ratio;
}

double plateFragments(const Material& material, double joules, double area, double perimeter, double thickness) {
    return squared((newSurfaceOf(material, joules) / thickness + perimeter) / (CELL_OUTLINE * std::sqrt(area)));
}

double expectedFragments(const Material& material, const BodyForm& form, double joules) {
    const double all = newSurfaceOf(material, joules) + form.surface;
    const double count = isPlate(form, all)
                             ? plateFragments(material, joules, squared(form.side), CELL_OUTLINE * form.side, form.thickness)
                             : solidFragments(material, joules, form.volume, form.surface);
    return std::max(1.0, count);
}

double roomForFragments(const Material& material, const BodyForm& form) {
    const double across = form.side / material.smallest_cell, deep = form.thickness / material.smallest_cell;
    return std::max(1.0, squared(across) * std::max(1.0, deep));
}

uint32_t fragmentCount(const Material& material, const BodyForm& form, double joules, uint32_t budget) {
    const double most = budget == 0 ? std::numeric_limits<uint32_t>::max() : budget;
    const double count = std::min(expectedFragments(material, form, joules), roomForFragments(material, form));
    return static_cast<uint32_t>(std::floor(std::min(count, most)));
}

double crackAreaOf(const BodyForm& form, double count) {
    if (count <= 1) return 0;
    if (form.thickness < form.side && count <= mostInPlate(form))
        return std::max(0.0, (std::sqrt(count) - 1) * CELL_OUTLINE * form.side * form.thickness / 2);
    const double all = CELL_SURFACE * squared(std::cbrt(form.volume)) * std::cbrt(count);
    // Counts that lie between what the two laws say at the switch are reached by it, and not before.
    const double least = form.thickness < form.side ? surfaceAtSwitch(form) : form.surface;
    return (std::max(all, least) - form.surface) / 2;
}

double energyForFragments(const Material& material, const BodyForm& form, double count) {
    const double area = crackAreaOf(form, count);
    return area > 0 ? material.fracture_energy * area / material.eta : 0;
}

} // namespace brittle
