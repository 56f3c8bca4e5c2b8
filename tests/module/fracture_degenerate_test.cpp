// Degenerate sites meet degenerate models: bisectors in faces, through edges and corners; plates and rods; models of any size,
// anywhere; sites outside.
#include "tests/hard/hard_sites.h"
#include "tests/module/whole_fracture.h"
#include "tests/support/shared_meshes.h"
#include "tests/support/solids.h"

#include "modules/brittle/mesh/primitives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace {

using brittle::Double3;
using brittle::FractureOptions;
using namespace whole;
using Sites = std::vector<Double3>;

Sites latticeOver(double reach, double step) {
    Sites sites;
    for (double x = -reach; x <= reach; x += step)
        for (double y = -reach; y <= reach; y += step)
            for (double z = -reach; z <= reach; z += step)
                sites.push_back({x, y, z});
    return sites;
}

Sites sitesIn(const Double3& lower, const Double3& upper, int count, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    Sites sites;
    for (int s = 0; s < count; ++s) {
        Double3 site;
        for (size_t k = 0; k < 3; ++k)
            site[k] = lower[k] + share(random) * (upper[k] - lower[k]);
        sites.push_back(site);
    }
    return sites;
}

// Every site with its image in each plane of triangles.
Sites withImages(const Sites& sites, const reference::Triangles& triangles) {
    using reference::operator-;
    using reference::operator*;
    using reference::operator+;
    Sites all = sites;
    for (const reference::Triangle& t : triangles) {
        const reference::Point across = reference::cross(t[1] - t[0], t[2] - t[0]);
        const reference::Point normal = 1 / reference::length(across) * across;
        for (const Double3& s : sites)
            all.push_back(reference::Point(s) + -2 * reference::dot(reference::Point(s) - t[0], normal) * normal);
    }
    return all;
}

Sites verticesOf(const Model& model, size_t most) {
    Sites sites;
    const auto& positions = model.prepared.mesh.positions;
    const size_t step = positions.size() / most + 1;
    for (size_t v = 0; v < positions.size(); v += step)
        sites.push_back({positions[v][0] + model.prepared.mesh.center[0], positions[v][1] + model.prepared.mesh.center[1],
                         positions[v][2] + model.prepared.mesh.center[2]});
    return sites;
}

void expectContractWithBothCapsAt(const Model& convex, const Sites& sites) {
    for (const brittle::Caps caps : {brittle::Caps::Exact, brittle::Caps::Convex}) {
        SCOPED_TRACE(caps == brittle::Caps::Exact ? "caps exact" : "caps convex");
        FractureOptions options;
        options.given_sites = sites;
        options.caps = caps;
        expectContract(convex, options);
    }
}

// Bisectors in the faces of the model: a cube split by a lattice whose planes are the cube's own.
TEST(FractureTies, LatticesInAndThroughTheFacesOfACube) {
    const Model cube = modelFrom("builtin:cube");
    for (const double step : {1.0, 0.5, 0.25}) {
        SCOPED_TRACE(step);
        expectContractWithBothCapsAt(cube, latticeOver(1, step));
    }
}

// Of the origin and its images: x + y = 1 runs through an edge of the cube, x + y + z = 1.5 through a corner.
TEST(FractureTies, BisectorsThroughTheEdgesAndCornersOfACube) {
    const Model cube = modelFrom("builtin:cube");
    Sites edges = {{0, 0, 0}}, corners = edges, all = edges;
    for (const Double3& s : latticeOver(1, 1)) {
        const double squared = s[0] * s[0] + s[1] * s[1] + s[2] * s[2];
        if (squared == 2) edges.push_back(s);
        if (squared == 3) corners.push_back(s);
        if (squared > 1) all.push_back(s);
    }
    for (Sites sites : {edges, corners, all}) {
        expectContractWithBothCapsAt(cube, sites);
        for (const Double3& s : sitesIn({-.5, -.5, -.5}, {.5, .5, .5}, 30))
            sites.push_back(s);
        expectContractWithBothCapsAt(cube, sites);
    }
}

TEST(FractureTies, SitesInOnePlaneAndOutsideTheModel) {
    const Model cube = modelFrom("builtin:cube");
    Sites sites;
    for (int k = 0; k < 20; ++k)
        sites.push_back({-1.5 + 0.15 * k, 0.1 * (k % 3), 0});
    expectContractWithBothCapsAt(cube, sites);
}

TEST(FractureTies, SitesOnTheCornersOfTheModel) {
    for (const char* name : {"builtin:cube", "builtin:icosphere:1", "builtin:icosphere:2", "builtin:ring", "builtin:bumpy:2"}) {
        SCOPED_TRACE(name);
        const Model model = modelFrom(std::string(name));
        expectContractAt(model, verticesOf(model, 400));
    }
}

TEST(FractureTies, ImagesOfSitesInEveryFace) {
    const Sites inside = sitesIn({-.4, -.4, -.4}, {.4, .4, .4}, 6);
    for (const char* name : {"builtin:cube", "builtin:icosphere:0", "builtin:icosphere:1"}) {
        SCOPED_TRACE(name);
        const Model model = modelFrom(std::string(name));
        expectContractWithBothCapsAt(model, withImages(inside, model.triangles));
    }
}

// A body-centered lattice over the unit cube: walls of hollows lie in bisectors, to within a step of the grid.
Sites centeredLattice() {
    Sites sites;
    for (int x = 0; x <= 6; ++x)
        for (int y = 0; y <= 6; ++y)
            for (int z = 0; z <= 6; ++z)
                for (const double shift : {-0.5, -0.5 + 1.0 / 12})
                    sites.push_back({x / 6.0 + shift, y / 6.0 + shift, z / 6.0 + shift});
    return sites;
}

TEST(FractureTies, WallsOfHollowsInBisectors) {
    using namespace support;
    const brittle::ImportedMesh outside = boxOf({-.5, -.5, -.5}, {.5, .5, .5});
    for (const auto& [lower, upper] : {std::pair{-.25, .25}, std::pair{-1. / 3, 0.}, std::pair{-.2, .1}})
        expectContractAt(modelFrom(outside + turnedOver(boxOf({lower, lower, lower}, {upper, upper, upper}))),
                         centeredLattice());
}

// Down to less than two steps of the grid. Films between a face and the bisector of a site and its image belong to somebody.
TEST(FractureThin, Plates) {
    for (const double thickness : {1e-2, 1e-4, 1e-6, 1.6e-7, 1e-7}) {
        SCOPED_TRACE(thickness);
        const Model plate = modelFrom(boxOf({-.5, -.5, 0}, {.5, .5, thickness}));
        // Sites that reach further than the plate make the grid coarser.
        Sites lattice = centeredLattice();
        if (thickness < 1.5e-7)
            std::erase_if(lattice, [](const Double3& s) { return std::max({s[0], s[1], std::fabs(s[2]) + .1}) > .5; });
        expectContractAt(plate, lattice);
        expectContractOf(plate, {2, 150});
        const Sites inside = sitesIn({-.5, -.5, 0}, {.5, .5, thickness}, 40);
        const reference::Triangles faces = {plate.triangles[8], plate.triangles[10]}; // one of each side
        expectContractAt(plate, withImages(inside, faces));
    }
}

TEST(FractureThin, WhatIsFlatOnTheGridOfTheEventIsRefused) {
    const Model plate = modelFrom(boxOf({-.5, -.5, 0}, {.5, .5, 1e-7}));
    FractureOptions options;
    options.given_sites = {{0, 0, 0}, {10, 0, 0}};
    const auto result = fracture().shatter(plate.prepared.mesh, plate.prepared.topology, options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, engine::ErrorCode::BadInput);
    EXPECT_NE(result.error().message.find("flat on the grid of the event"), std::string::npos);
}

// Along the diagonal of their box, of which they fill a ten-thousandth.
TEST(FractureThin, SitesFindTheirPlacesInRodsAtAnAngle) {
    for (const double thickness : {0x1p-4, 0x1p-7}) { // floats hold them as they are
        brittle::ImportedMesh rod = boxOf({0, 0, 0}, {1, thickness, thickness});
        for (Double3& p : rod.positions) {
            const double a = p[0] - p[1], b = p[0] + p[1];
            p = {a - p[2], b - p[2] / 2, p[0] + 1.5 * p[2]};
        }
        expectContractOf(modelFrom(rod), {1, 20, 200});
    }
}

// Off the grid in all directions: films are wedges then, up to hundreds of steps.
TEST(FractureThin, PlatesAtAnAngle) {
    for (const double thickness : {1e-1, 1e-2}) {
        SCOPED_TRACE(thickness);
        brittle::ImportedMesh box = boxOf({-.5, -.5, 0}, {.5, .5, thickness});
        const auto turned = [](const Double3& p) {
            const double a = .7, b = .4, x = p[0] * std::cos(a) - p[1] * std::sin(a),
                         y = p[0] * std::sin(a) + p[1] * std::cos(a);
            return Double3{x, y * std::cos(b) - p[2] * std::sin(b), y * std::sin(b) + p[2] * std::cos(b)};
        };
        for (Double3& p : box.positions)
            p = turned(p);
        const Model plate = modelFrom(box);
        Sites sites;
        for (const Double3& s : sitesIn({-.5, -.5, 0}, {.5, .5, thickness}, 40))
            for (const double z : {s[2], -s[2], 2 * thickness - s[2]})
                sites.push_back(turned({s[0], s[1], z}));
        expectContractAt(plate, sites);
        expectContractOf(plate, {150});
    }
}

TEST(FractureThin, RodsAndNeedles) {
    for (const double thickness : {1e-2, 1e-4}) {
        SCOPED_TRACE(thickness);
        const Model rod = modelFrom(boxOf({-.5, 0, 0}, {.5, thickness, thickness}));
        expectContractAt(rod, sitesIn({-.5, 0, 0}, {.5, thickness, thickness}, 100));
        expectContractAt(rod, centeredLattice());
        expectContractAt(rod, withImages(sitesIn({-.5, 0, 0}, {.5, thickness, thickness}, 20), rod.triangles));
    }
    brittle::ImportedMesh needle = boxOf({-.5, -.5, -.5}, {.5, .5, .5}); // comes to a point of 1e-6
    for (Double3& p : needle.positions)
        for (size_t k = 1; k < 3; ++k)
            p[k] *= p[0] > 0 ? 1e-6 : 1e-3;
    expectContractOf(modelFrom(needle), {1, 2, 60});
}

brittle::ImportedMesh scaledRing(double scale, const Double3& by) {
    return support::moved(brittle::makeBuiltin("ring").value(), scale, by);
}

TEST(FractureScale, FromABillionthToABillionAndAsFarAsItIsTaken) {
    for (const double scale : {2.5e-11, 1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9, 2.3e9}) {
        SCOPED_TRACE(scale);
        expectContractOf(modelFrom(scaledRing(scale, {0, 0, 0})), {40});
    }
}

TEST(FractureScale, FarFromTheOrigin) {
    expectContractOf(modelFrom(scaledRing(1, {1e7, -1e7, 3e7})), {1, 40});
    expectContractOf(modelFrom(scaledRing(1e-3, {1e4, 1e4, 1e4})), {40});
    const Double3 by = {1e7, -2e7, 1e7};
    Sites sites = latticeOver(1, .5);
    for (Double3& s : sites)
        for (size_t k = 0; k < 3; ++k)
            s[k] += by[k];
    expectContractAt(modelFrom(support::moved(brittle::makeCube(), 1, by)), sites);
}

// Powers of two change no digit, so that all measures must come out alike but for their unit.
TEST(FractureScale, ChangesNoMeasure) {
    const auto broken = [](int exponent) {
        const Model ring = modelFrom(scaledRing(std::ldexp(1.0, exponent), {0, 0, 0}));
        FractureOptions options;
        options.site_count = 200;
        auto result = fracture().shatter(ring.prepared.mesh, ring.prepared.topology, options);
        EXPECT_TRUE(result) << result.error().message;
        return result->fragments.fragments;
    };
    const auto usual = broken(0);
    for (const int exponent : {-30, 27}) {
        const auto fragments = broken(exponent);
        ASSERT_EQ(fragments.size(), usual.size());
        for (size_t f = 0; f < usual.size(); ++f) {
            ASSERT_EQ(std::ldexp(fragments[f].volume, -3 * exponent), usual[f].volume);
            for (size_t k = 0; k < 3; ++k) {
                ASSERT_EQ(std::ldexp(fragments[f].centroid[k], -exponent), usual[f].centroid[k]);
                ASSERT_EQ(std::ldexp(fragments[f].lower[k], -exponent), usual[f].lower[k]);
            }
        }
    }
}

// The same ties on real models: sites on their corners, in lattices over their boxes, and with images in their faces.
class TiesOnModels : public testing::TestWithParam<const char*> {};

TEST_P(TiesOnModels, HoldTheContract) {
    SKIP_WITHOUT_MESHES();
    const Model model = modelFrom(GetParam());
    const reference::Bounds box = reference::boundsOf(model.triangles);
    {
        SCOPED_TRACE("sites on corners");
        expectContractAt(model, verticesOf(model, 1000));
    }
    for (const int steps : {2, 5, 10}) {
        SCOPED_TRACE(std::to_string(steps) + " lattice steps");
        Sites lattice = latticeOver(1, 2.0 / steps);
        for (Double3& s : lattice)
            for (size_t k = 0; k < 3; ++k)
                s[k] = .5 * (box.lower[k] + box.upper[k]) + .5 * s[k] * (box.upper[k] - box.lower[k]);
        expectContractAt(model, lattice);
    }
    for (const unsigned seed : {1u, 2u}) {
        SCOPED_TRACE("images in faces, seed " + std::to_string(seed));
        std::mt19937 random(seed);
        reference::Triangles faces;
        for (int k = 0; k < 60; ++k)
            faces.push_back(model.triangles[random() % model.triangles.size()]);
        std::erase_if(faces, [](const reference::Triangle& t) {
            return reference::length(reference::cross(reference::operator-(t[1], t[0]), reference::operator-(t[2], t[0]))) == 0;
        });
        expectContractAt(model, withImages(sitesIn(box.lower, box.upper, 8, seed), faces));
    }
}

std::string nameOf(const testing::TestParamInfo<const char*>& info) {
    std::string name = info.param;
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Long, TiesOnModels,
                         testing::Values("ico4.obj", "spot_low_resolution.obj", "bunny_hr.obj", "armadillo.obj", "fandisk.off",
                                         "gearwheel.bin.stl", "1002_tray_bottom.STL", "thingi10k-472042.stl",
                                         "thingi10k-908460.stl", "couplingdown.off", "torus.obj", "trefoil.obj", "cheese.off",
                                         "sword.obj", "goblet-Vase.stl", "hundred_cubes.obj", "thingi10k-99865.stl",
                                         "capsule.obj", "ellipe0.003.off", "utah_teapot.stl"),
                         nameOf);

// The paper's Fig. 10: a cell that lies wholly outside of the model, and one that pokes through its surface.
TEST(FractureOutside, CellsWithoutAnyPieceAreEmpty) {
    const Model cube = modelFrom("builtin:cube");
    const Sites sites = {{-.2, 0, 0}, {.2, .1, 0}, {.7, .1, 0}, {3, 3, 3}, {-4, 0, 0}};
    expectContractAt(cube, sites);
    FractureOptions options;
    options.given_sites = sites;
    const auto result = fracture().shatter(cube.prepared.mesh, cube.prepared.topology, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->counts.cells_ok, 3u);
    EXPECT_EQ(result->counts.cells_empty, 2u);
    expectContractAt(cube, {{.1, .2, .3}, {100, 0, 0}});
    expectContractAt(cube, {{5, 0, 0}, {0, 6, 0}, {0, 0, -7}});
}

TEST(FractureOutside, CellsOfAllKindsAroundAModel) {
    const Model ring = modelFrom("builtin:ring");
    for (const double reach : {1.5, 5.0, 50.0})
        expectContractAt(ring, sitesIn({-reach, -reach, -reach}, {reach, reach, reach}, 300));
}

} // namespace
