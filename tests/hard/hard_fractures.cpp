#include "tests/hard/hard_fractures.h"

#include "modules/brittle/fracture/refracture.h"
#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/mesh/primitives.h"
#include "tests/hard/hard_sites.h"
#include "tests/reference/contract.h"
#include "tests/support/fragment_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hard {
namespace {

using brittle::Double3, brittle::FractureResult, brittle::ImportedMesh, brittle::PreparedMesh;
using Sites = std::vector<Double3>;

ImportedMesh boxOf(const Double3& lower, const Double3& upper) {
    ImportedMesh box = brittle::makeCube();
    for (Double3& p : box.positions)
        for (size_t k = 0; k < 3; ++k)
            p[k] = p[k] < 0 ? lower[k] : upper[k];
    return box;
}

ImportedMesh builtin(const char* name) { return brittle::makeBuiltin(name).value(); }

ImportedMesh cube(double) { return brittle::makeCube(); }
ImportedMesh ball(double) { return builtin("icosphere:2"); }
ImportedMesh plate(double thickness) { return boxOf({-.5, -.5, 0}, {.5, .5, thickness}); }
ImportedMesh rod(double thickness) { return boxOf({-.5, 0, 0}, {.5, thickness, thickness}); }
ImportedMesh scaledRing(double scale) {
    ImportedMesh ring = builtin("ring");
    for (Double3& p : ring.positions)
        for (double& x : p)
            x *= scale;
    return ring;
}
ImportedMesh farRing(double distance) {
    ImportedMesh ring = builtin("ring");
    for (Double3& p : ring.positions)
        p = {p[0] + distance, p[1] - distance, p[2] + 3 * distance};
    return ring;
}

// Comes to a point.
ImportedMesh needle(double point) {
    ImportedMesh mesh = brittle::makeCube();
    for (Double3& p : mesh.positions)
        for (size_t k = 1; k < 3; ++k)
            p[k] *= p[0] > 0 ? point : 1e-3;
    return mesh;
}

// A drum of triangles that are thousands of times as long as they are wide.
ImportedMesh slivers(double length) {
    constexpr uint32_t kSides = 600;
    ImportedMesh drum;
    for (uint32_t s = 0; s < kSides; ++s) {
        const double angle = 2 * std::numbers::pi * s / kSides;
        for (const double x : {-length / 2, length / 2})
            drum.positions.push_back({x, std::cos(angle), std::sin(angle)});
    }
    const auto at = [](uint32_t s, uint32_t end) { return 2 * (s % kSides) + end; };
    for (uint32_t s = 0; s < kSides; ++s) {
        drum.triangles.push_back({at(s, 0), at(s + 1, 1), at(s, 1)});
        drum.triangles.push_back({at(s, 0), at(s + 1, 0), at(s + 1, 1)});
        if (s == 0 || s + 1 == kSides) continue;
        drum.triangles.push_back({at(0, 0), at(s + 1, 0), at(s, 0)});
        drum.triangles.push_back({at(0, 1), at(s, 1), at(s + 1, 1)});
    }
    drum.corner_normals.resize(3 * drum.triangles.size());
    drum.corner_uvs.resize(3 * drum.triangles.size());
    return drum;
}

// From -reach to reach on every axis.
Sites lattice(double reach, double step) {
    Sites sites;
    for (double x = -reach; x <= reach; x += step)
        for (double y = -reach; y <= reach; y += step)
            for (double z = -reach; z <= reach; z += step)
                sites.push_back({x, y, z});
    return sites;
}

// Each with its image in the plane through the origin: the bisectors of all pairs are that plane.
Sites mirrored(uint32_t count) {
    Sites sites;
    for (const Point& p : uniformSites(count, 1).sites)
        for (const double side : {-1.0, 1.0})
            sites.push_back({p[0] - .5, p[1] - .5, side * (p[2] / 2)});
    return sites;
}

ImportedMesh boxOfSet(double number) {
    const HardSites set = hardSites()[static_cast<size_t>(number)];
    return boxOf(set.lower, set.upper);
}

std::vector<FractureCase> siteSets() {
    std::vector<FractureCase> cases;
    for (const HardSites& set : hardSites())
        cases.push_back({.name = "sites: " + set.name,
                         .model = boxOfSet,
                         .parameter = static_cast<double>(cases.size()),
                         .sites = set.sites});
    return cases;
}

engine::Result<FractureResult> broken(brittle::Fracture& fracture, const PreparedMesh& model, const FractureCase& self,
                                      brittle::Precision precision) {
    brittle::FractureOptions options;
    options.given_sites = self.sites;
    options.site_count = self.site_count;
    options.precision = precision;
    return fracture.shatter(model.mesh, model.topology, options);
}

// What an earlier cut has left is part of the surface now.
reference::FragmentFile asBrokenOnce(brittle::FragmentSet set) {
    for (brittle::Fragment& fragment : set.fragments)
        fragment.earlier_index_count = 0;
    return support::fragmentFile(set);
}

struct Worst {
    double promises = 0, volume = 0, area = 0, outside = 0;
};

void measure(const PreparedMesh& model, const FractureResult& result, Worst& worst) {
    reference::ContractLimits limits;
    limits.random_points = 100;
    limits.bisector_tests = 20'000'000;
    const auto report = reference::checkContract(asBrokenOnce(result.fragments), support::trianglesOf(model.mesh), limits);
    worst.promises += static_cast<double>(report.brokenPromises());
    worst.volume = std::max(worst.volume, report.volume_error);
    worst.area = std::max(worst.area, report.area_error);
    worst.outside = std::max(worst.outside, report.outside_cell);
}

size_t largestOf(const brittle::FragmentSet& set) {
    const auto by_volume = [](const brittle::Fragment& a, const brittle::Fragment& b) { return a.volume < b.volume; };
    return static_cast<size_t>(std::ranges::max_element(set.fragments, by_volume) - set.fragments.begin());
}

void checkWorst(Trial& trial, const Worst& worst) {
    const reference::ContractLimits limits;
    trial.check("promises broken", worst.promises, 0);
    trial.check("volume, off by a share", worst.volume, limits.volume_error);
    trial.check("outer area, off by a share", worst.area, limits.area_error);
    trial.check("corner beyond its cell, of the diagonal", worst.outside, limits.outside_cell);
}

} // namespace

std::vector<FractureCase> fractureCases() {
    std::vector<FractureCase> cases = siteSets();
    cases.push_back({.name = "lattice through a cube's faces", .model = cube, .sites = lattice(1, 0.25)});
    cases.push_back({.name = "sites on a cube's corners", .model = cube, .sites = lattice(.5, 1)});
    cases.push_back({.name = "coplanar bisectors", .model = cube, .sites = mirrored(60)});
    cases.push_back({.name = "ball in one cell", .model = ball, .site_count = 1});
    cases.push_back({.name = "ball in two cells", .model = ball, .site_count = 2});
    for (const double thickness : {1e-2, 1e-4, 1e-6, 1e-7})
        cases.push_back({.name = "plate, 1e" + std::to_string(std::lround(std::log10(thickness))) + " as thick as wide",
                         .model = plate,
                         .parameter = thickness,
                         .site_count = 100});
    cases.push_back({.name = "rod, 1e-4 as thick as long", .model = rod, .parameter = 1e-4, .site_count = 100});
    cases.push_back({.name = "needle with a point of 1e-6", .model = needle, .parameter = 1e-6, .site_count = 60});
    cases.push_back({.name = "model of slivers in two cells", .model = slivers, .parameter = 100, .site_count = 2});
    cases.push_back({.name = "model of slivers", .model = slivers, .parameter = 100, .site_count = 40});
    for (const double scale : {1e-9, 1e-3, 1e6, 1e9})
        cases.push_back({.name = "ring of size 1e" + std::to_string(std::lround(std::log10(scale))),
                         .model = scaledRing,
                         .parameter = scale,
                         .site_count = 40});
    cases.push_back({.name = "ring 3e7 from the origin", .model = farRing, .parameter = 1e7, .site_count = 40});
    cases.push_back({.name = "ball broken eight times over", .model = ball, .site_count = 6, .depth = 8});
    return cases;
}

FractureCost measureFracture(Trial& trial, brittle::Fracture& fracture, const FractureCase& self,
                             brittle::Precision precision) {
    FractureCost cost;
    Worst worst;
    auto model = brittle::prepareMesh(self.model(self.parameter));
    for (uint32_t depth = 1; model; ++depth) {
        const auto result = broken(fracture, *model, self, precision);
        if (!result) {
            trial.fail(result.error().message);
            return cost;
        }
        cost.ms += result->total_ms;
        cost.exact_tests += result->counts.exact_redone;
        measure(*model, *result, worst);
        if (depth == self.depth) {
            checkWorst(trial, worst);
            return cost;
        }
        model = brittle::prepareFragment(result->fragments, largestOf(result->fragments));
    }
    trial.fail(model.error().message);
    return cost;
}

} // namespace hard
