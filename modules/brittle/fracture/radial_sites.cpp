#include "modules/brittle/fracture/radial_sites.h"

#include "modules/brittle/fracture/plate.h"
#include "modules/brittle/mesh/format.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace brittle {
namespace {

using Place = std::array<double, 2>;

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kLength = 1.5;                      // of a cell, over its width
constexpr double kLeastCore = 0.01, kMostCore = 0.5; // innermost ring, of the reach
constexpr double kInnermost = 1e-4;                  // of the furthest place: no ring is smaller
constexpr double kMostSpokes = 4096;
constexpr double kGrace = 0.01; // of the model's size, that a blow may lie beside it

// Places of a cell that are looked at, as lib/draw_radial.glsl has them.
constexpr double kAngles[] = {1.0 / 6, -1.0 / 6, 0.5, -0.5, 5.0 / 6, -5.0 / 6};
constexpr double kDepths[] = {1.0 / 8, 3.0 / 8, 5.0 / 8, 7.0 / 8};
constexpr double kLeastCosine = 1.0 / 8;

// splitmix64 (Steele, Lea, Flood, Fast splittable pseudorandom number generators, 2014), to [0, 1).
double chanceOf(uint64_t seed, uint64_t number) {
    uint64_t z = seed + (number + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

struct Rings {
    std::vector<double> angles; // of sectors' sites, growing
    double outermost = 0;       // radius of its sites
    double ratio = 0;           // of a radius to the next one inwards
};

class RadialPattern {
public:
    RadialPattern(const Plate& plate, const Place& blow, double core) : plate_(plate), blow_(blow) {
        reach_ = std::max(plate.reachFrom(blow), 1e-3 * std::sqrt(plate.area()));
        furthest_ = plate.furthestFrom(blow);
        core_ = std::clamp(core, kLeastCore * reach_, kMostCore * reach_);
    }

    // Cells grow by the ratio q from ring to ring, and are 2 pi / n times their radius wide.
    Rings ringsFor(uint32_t count, uint64_t seed, double finer) const {
        const double span = std::log(reach_ / core_), disk = std::sqrt(plate_.area() / std::numbers::pi);
        const double seen = std::clamp(reach_ / disk, 0.25, 1.0); // of all directions
        const double wanted = std::sqrt(kLength * kTurn * count / (span * seen));
        const double spokes = std::clamp(std::round(wanted), 1.0, std::min(kMostSpokes, std::max(1.0, count / seen)));
        const double rings = std::max(finer * count / (spokes * seen), 1.0);
        Rings r;
        r.ratio = std::exp(std::max(span / rings, 1e-4));
        r.outermost = furthest_ * std::pow(r.ratio, -chanceOf(seed, 0));
        for (uint32_t k = 0; k < spokes; ++k)
            r.angles.push_back(kTurn / spokes * (k + 0.5 * chanceOf(seed, k + 1)));
        return r;
    }

    // From the outermost ring inwards, as many as are asked for, or as there is room for.
    std::vector<Place> place(const Rings& r, uint32_t count) const {
        std::vector<Place> sites;
        for (double radius = r.outermost; radius > kInnermost * furthest_ && sites.size() < count; radius /= r.ratio)
            for (size_t s = 0; s < r.angles.size() && sites.size() < count; ++s)
                if (isWanted(r, s, radius)) sites.push_back(at(radius, r.angles[s]));
        return sites;
    }

private:
    Place at(double radius, double angle) const {
        return {blow_[0] + radius * std::cos(angle), blow_[1] + radius * std::sin(angle)};
    }

    // Half of the way to the next sector's angle, on either side.
    double halfSector(const Rings& r, size_t s, bool left) const {
        const size_t n = r.angles.size(), next = left ? (s + n - 1) % n : (s + 1) % n;
        const double turn = left ? r.angles[s] - r.angles[next] : r.angles[next] - r.angles[s];
        return (turn > 0 ? turn : turn + kTurn) / 2;
    }

    bool isWanted(const Rings& r, size_t s, double radius) const {
        const double low = radius * (1 + 1 / r.ratio) / 2, high = radius * (1 + r.ratio) / 2;
        for (const double depth : kDepths)
            for (const double part : kAngles) {
                const double turn = part * halfSector(r, s, part < 0);
                const double way = (low + (high - low) * depth) / std::max(std::cos(turn), kLeastCosine);
                if (plate_.isInside(at(way, r.angles[s] + turn))) return true;
            }
        return false;
    }

    const Plate& plate_;
    Place blow_;
    double reach_ = 0, furthest_ = 0, core_ = 0;
};

engine::Result<void> checkFlat(const PrincipalBox& box) {
    if (kFlat * box.edges[0] < box.edges[1]) return {};
    return engine::Error{engine::ErrorCode::BadInput,
                         "the pattern radial is for what is flat and thinner than a third of its width; this is " +
                             formatNumber(box.edges[0]) + " thick and " + formatNumber(box.edges[1]) +
                             " wide; use the pattern impact"};
}

engine::Result<void> checkBlow(const Mesh& mesh, const Double3& place) {
    Box box;
    for (const Float3& p : mesh.positions)
        box.grow(toDouble(p) + mesh.center);
    for (size_t k = 0; k < 3; ++k) {
        const double grace = kGrace * box.diagonal();
        if (!(place[k] >= box.lower[k] - grace) || !(place[k] <= box.upper[k] + grace))
            return engine::Error{engine::ErrorCode::BadInput, "the impact at " + formatPoint(place) +
                                                                  " lies beside the model, whose box goes from " +
                                                                  formatPoint(box.lower) + " to " + formatPoint(box.upper) +
                                                                  "; the pattern radial needs one on it"};
    }
    return {};
}

} // namespace

engine::Result<std::vector<Double3>> radialSites(const Mesh& mesh, const Impact& impact, uint32_t count, uint64_t seed) {
    const PrincipalBox box = principalBoxOf(mesh);
    if (auto flat = checkFlat(box); !flat) return flat.error();
    if (auto on = checkBlow(mesh, impact.place); !on) return on.error();
    const Plate plate(mesh, box.axes[0]);
    const RadialPattern pattern(plate, plate.onPlane(impact.place - mesh.center), impact.contact_radius);
    std::vector<Place> places;
    // Where the plate is no disk around the blow there may be fewer in sight than thought.
    for (double finer = 1; places.size() < count && finer < 1000; finer *= 1.25)
        places = pattern.place(pattern.ringsFor(count, seed, finer), count);
    if (places.size() < count)
        return engine::Error{engine::ErrorCode::Capacity, "there is room for " + std::to_string(places.size()) + " of " +
                                                              std::to_string(count) + " sites in rings; ask for fewer"};
    std::vector<Double3> sites;
    for (const Place& p : places)
        sites.push_back(plate.fromPlane(p) + mesh.center);
    return sites;
}

} // namespace brittle
