// Whole fractures of many models, by the pattern and at sites that are in ties, against the contract; and what is refused.
#include "modules/brittle/export/glb.h"
#include "modules/brittle/mesh/measures.h"
#include "modules/brittle/mesh/primitives.h"
#include "tests/hard/hard_sites.h"
#include "tests/module/whole_fracture.h"
#include "tests/support/shared_meshes.h"
#include "tests/support/solids.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using brittle::FractureOptions;
using namespace whole;

struct Case {
    const char* model;
    uint32_t sites;
    uint64_t seed = 1;
};

std::string nameOf(const testing::TestParamInfo<Case>& info) {
    std::string name =
        std::string(info.param.model) + "_" + std::to_string(info.param.sites) + "_seed" + std::to_string(info.param.seed);
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

class FractureContract : public testing::TestWithParam<Case> {};

TEST_P(FractureContract, Holds) {
    const Case& c = GetParam();
    if (!std::string(c.model).starts_with("builtin:")) SKIP_WITHOUT_MESHES();
    FractureOptions options;
    options.site_count = c.sites;
    options.seed = c.seed;
    expectContract(modelFrom(c.model), options);
}

INSTANTIATE_TEST_SUITE_P(Small, FractureContract,
                         testing::Values(Case{"builtin:cube", 1}, Case{"builtin:cube", 2}, Case{"builtin:cube", 65},
                                         Case{"builtin:icosphere:2", 12}, Case{"ico4.obj", 10}, Case{"hundred_cubes.obj", 10}),
                         nameOf);
constexpr const char* kModels[] = {"ico4.obj",      "spot_low_resolution.obj", "utah_teapot.stl", "bunny_hr.obj",
                                   "fandisk.off",   "gearwheel.bin.stl",       "torus.obj",       "trefoil.obj",
                                   "cheese.off",    "couplingdown.off",        "goblet-Vase.stl", "hundred_cubes.obj",
                                   "armadillo.obj", "thingi10k-908460.stl"};

std::vector<Case> casesOf(std::initializer_list<uint32_t> site_counts, std::initializer_list<uint64_t> seeds) {
    std::vector<Case> cases;
    for (const char* model : kModels)
        for (const uint32_t sites : site_counts)
            for (const uint64_t seed : seeds)
                cases.push_back({model, sites, seed});
    return cases;
}

INSTANTIATE_TEST_SUITE_P(Quick, FractureContract,
                         testing::Values(Case{"builtin:icosphere:3", 63}, Case{"builtin:icosphere:3", 64},
                                         Case{"builtin:ring", 40}, Case{"builtin:bumpy:4", 300}),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(QuickModels, FractureContract, testing::ValuesIn(casesOf({1, 2, 10, 100, 1000}, {1})), nameOf);
INSTANTIATE_TEST_SUITE_P(Long, FractureContract, testing::ValuesIn(casesOf({3, 10, 30, 100, 300, 1000}, {2, 3, 4})), nameOf);
INSTANTIATE_TEST_SUITE_P(LongMany, FractureContract, testing::ValuesIn(casesOf({5000}, {1})), nameOf);

// Sites in ties with each other, with the box and with the model: the 27 sets, spread over the model's box.
struct HardCase {
    size_t set;
    const char* model;
};

FractureOptions sitesOver(const hard::HardSites& hard, const Model& model) {
    const reference::Bounds bounds = reference::boundsOf(model.triangles);
    FractureOptions options;
    for (const hard::Point& p : hard.sites) {
        brittle::Double3 site;
        for (size_t k = 0; k < 3; ++k)
            site[k] = bounds.lower[k] +
                      (p[k] - hard.lower[k]) / (hard.upper[k] - hard.lower[k]) * (bounds.upper[k] - bounds.lower[k]);
        options.given_sites.push_back(site);
    }
    return options;
}

class HardSitesContract : public testing::TestWithParam<HardCase> {};

TEST_P(HardSitesContract, Holds) {
    if (!std::string(GetParam().model).starts_with("builtin:")) SKIP_WITHOUT_MESHES();
    const hard::HardSites hard = hard::hardSites()[GetParam().set];
    SCOPED_TRACE(hard.name);
    const Model model = modelFrom(GetParam().model);
    expectContract(model, sitesOver(hard, model));
}

std::vector<HardCase> hardCases(std::initializer_list<size_t> sets, std::initializer_list<const char*> models) {
    std::vector<HardCase> cases;
    for (const char* model : models)
        for (const size_t set : sets)
            cases.push_back({set, model});
    return cases;
}

std::string hardNameOf(const testing::TestParamInfo<HardCase>& info) {
    return nameOf({Case{info.param.model, static_cast<uint32_t>(info.param.set)}, info.index});
}

INSTANTIATE_TEST_SUITE_P(Small, HardSitesContract, testing::ValuesIn(hardCases({7, 16, 24, 25}, {"builtin:cube"})), hardNameOf);
INSTANTIATE_TEST_SUITE_P(Quick, HardSitesContract, testing::ValuesIn(hardCases({4, 10, 15, 17, 23, 26}, {"builtin:cube"})),
                         hardNameOf);
INSTANTIATE_TEST_SUITE_P(Long, HardSitesContract,
                         testing::ValuesIn(hardCases({0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13,
                                                      14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26},
                                                     {"builtin:cube", "spot_low_resolution.obj", "gearwheel.bin.stl"})),
                         hardNameOf);

TEST(FractureLimits, ManyCellsInAFewTriangles) {
    FractureOptions options;
    options.site_count = 2000;
    expectContract(modelFrom("builtin:cube"), options);
}

TEST(FractureLimits, ACellWithThreeHundredFaces) {
    const Model cube = modelFrom("builtin:cube");
    expectContract(cube, sitesOver(hard::sphereAroundCenter(300, .2), cube));
}

TEST(LongFractureLimits, ACellWithTwoThousandFaces) {
    const Model cube = modelFrom("builtin:cube");
    expectContract(cube, sitesOver(hard::sphereAroundCenter(2000, .3), cube));
}

// One in the middle, and `count` in a circle around it. Each triangle of the model that the circle crosses has about half as
// many sides in the middle cell.
FractureOptions sitesInACircle(int count) {
    FractureOptions options;
    options.given_sites = {{0, 0, 0}};
    for (int k = 0; k < count; ++k) {
        const double angle = 2 * M_PI * k / count;
        options.given_sites.push_back({0.3 * std::cos(angle), 0.3 * std::sin(angle), 0});
    }
    return options;
}

TEST(FractureLimits, APolygonOfManySides) {
    const Model cube = modelFrom("builtin:cube");
    for (const int count : {100, 300})
        expectContract(cube, sitesInACircle(count));
}

// A rod of 100 m x 2 cm: nearly every cell goes all the way through it.
Model longRod() { return modelFrom(boxOf({0, 0, 0}, {100, 0.02, 0.02})); }

TEST(LongFractureLimits, AnEdgeThatCrossesThousandsOfCells) {
    FractureOptions options;
    options.site_count = 14'000;
    expectContract(longRod(), options);
}

void expectRefusal(const Model& model, const FractureOptions& options, const std::string& reason) {
    const auto refused = fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
    ASSERT_FALSE(refused) << reason;
    EXPECT_EQ(refused.error().code, engine::ErrorCode::Capacity);
    EXPECT_NE(refused.error().message.find(reason), std::string::npos) << refused.error().message;
}

// Both would need more turns of a loop than a lane of Mesa's software device gets before it is ended without a word.
TEST(FractureLimits, WhatOneLaneCannotWalkThroughIsRefusedByName) {
    expectRefusal(modelFrom("builtin:cube"), sitesInACircle(700), "more than about 200 sides in one cell");
    FractureOptions options;
    options.site_count = 20'000;
    expectRefusal(longRod(), options, "meet too many cells");
}

TEST(FractureLimits, TwentyThousandCellsInACube) {
    FractureOptions options;
    options.site_count = 20'000;
    expectContract(modelFrom("builtin:cube"), options);
}

TEST(FractureLimits, AHundredThousandCellsAlone) {
    const Model cube = modelFrom("builtin:cube");
    FractureOptions options;
    options.site_count = 100'000;
    options.only_cells = true;
    const auto result = fracture().shatter(cube.prepared.mesh, cube.prepared.topology, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->counts.sites_used + result->counts.sites_welded, 100'000u);
    EXPECT_TRUE(result->fragments.fragments.empty());
}

TEST(LongFractureLimits, FiftyThousandCellsInACube) {
    FractureOptions options;
    options.site_count = 50'000;
    expectContract(modelFrom("builtin:cube"), options);
}

TEST(LongFractureLimits, AHundredThousandCellsInACube) {
    FractureOptions options;
    options.site_count = 100'000;
    expectContract(modelFrom("builtin:cube"), options);
}

TEST(LongFractureLimits, AModelOfManyTriangles) {
    for (const char* name : {"builtin:bumpy:7", "builtin:bumpy:8"}) { // 327,680 and 1,310,720 triangles
        SCOPED_TRACE(name);
        expectContractOf(modelFrom(std::string(name)), {100});
    }
}

Model hollowSphere(uint32_t level) {
    using namespace brittle;
    using namespace support;
    return modelFrom(makeIcosphere(level) + turnedOver(moved(makeIcosphere(level), 0.9, {0, 0, 0})));
}

TEST(FractureCavities, StayWithThePieceAroundThem) {
    using namespace brittle;
    using namespace support;
    expectContractOf(hollowSphere(3), {1, 2, 40});
    brittle::ImportedMesh cheese = moved(makeCube(), 10, {0, 0, 0});
    for (int x = -2; x <= 2; ++x)
        for (int y = -2; y <= 2; ++y)
            for (int z = -2; z <= 2; ++z)
                cheese = cheese + turnedOver(moved(makeIcosphere(1), 0.4, {1.5 * x, 1.5 * y, 1.5 * z}));
    expectContractOf(modelFrom(cheese), {1, 8, 100});
}

// The contract includes that the volumes add up to that of the whole block.
TEST(FractureCavities, MayBeFilledExactly) {
    using namespace support;
    const brittle::ImportedMesh filling = boxOf({-.2, -.2, -.2}, {.2, .2, .2});
    const Model filled = modelFrom(boxOf({-.5, -.5, -.5}, {.5, .5, .5}) + turnedOver(filling) + filling);
    EXPECT_NEAR(brittle::measureMesh(filled.prepared.mesh).volume, 1, 1e-6);
    expectContractOf(filled, {1, 20, 300});
}

// More triangles around the hollow than one lane may walk.
TEST(FractureLimits, AHollowModelOfManyTriangles) { expectContractOf(hollowSphere(6), {1, 3}); }

TEST(FractureRefuses, NoSitesAndSitesFarAway) {
    const Model cube = modelFrom("builtin:cube");
    FractureOptions options;
    options.site_count = 0;
    EXPECT_FALSE(fracture().shatter(cube.prepared.mesh, cube.prepared.topology, options));
    options.given_sites = {{0, 0, 0}, {1e9, 0, 0}};
    const auto result = fracture().shatter(cube.prepared.mesh, cube.prepared.topology, options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, engine::ErrorCode::BadInput);
}

TEST(FractureRefuses, MoreCellsThanTheDeviceCanBind) {
    const Model cube = modelFrom("builtin:cube");
    FractureOptions options;
    options.site_count = 1 << 24;
    const auto result = fracture().shatter(cube.prepared.mesh, cube.prepared.topology, options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, engine::ErrorCode::Capacity) << result.error().message;
}

TEST(FractureRepeats, TheSameBytesEveryTime) {
    const Model ring = modelFrom("builtin:ring");
    FractureOptions options;
    options.site_count = 50;
    std::string first;
    for (int run = 0; run < 3; ++run) {
        const auto result = fracture().shatter(ring.prepared.mesh, ring.prepared.topology, options);
        ASSERT_TRUE(result) << result.error().message;
        const auto bytes = brittle::encodeGlb(result->fragments);
        ASSERT_TRUE(bytes);
        if (run == 0) first = *bytes;
        EXPECT_TRUE(*bytes == first);
    }
}

} // namespace
