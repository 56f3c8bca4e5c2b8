// Whole fractures against the contract, as an outsider sees it: the exported file, read back by the checker's own reader, and
// the model, read by the checker's own reader.
#include "modules/brittle/export/glb.h"
#include "modules/brittle/fracture/fracture.h"
#include "modules/brittle/fracture/verify.h"
#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/mesh/primitives.h"
#include "tests/engine/test_device.h"
#include "tests/hard/hard_sites.h"
#include "tests/reference/contract.h"
#include "tests/reference/model_file.h"
#include "tests/support/shared_meshes.h"
#include "tests/support/solids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>

namespace {

using brittle::FractureOptions;
using brittle::FractureResult;
using brittle::PreparedMesh;

// One for all tests of the program, so that pipelines are made once; it goes before its device does.
class SharedFracture : public testing::Environment {
public:
    brittle::Fracture& get() {
        if (!fracture_) {
            auto made = brittle::Fracture::create(engine_test::device());
            if (!made) ADD_FAILURE() << made.error().message;
            fracture_ = std::move(*made);
        }
        return *fracture_;
    }
    void TearDown() override { fracture_.reset(); }

private:
    std::unique_ptr<brittle::Fracture> fracture_;
};
SharedFracture& shared_fracture = *static_cast<SharedFracture*>(testing::AddGlobalTestEnvironment(new SharedFracture));

struct Model {
    PreparedMesh prepared;
    reference::Triangles triangles; // as the checker's reader sees them
};

Model modelFrom(const brittle::ImportedMesh& imported) {
    auto prepared = brittle::prepareMesh(imported);
    EXPECT_TRUE(prepared) << prepared.error().message;
    Model model{std::move(*prepared), {}};
    for (const brittle::Index3& t : imported.triangles)
        model.triangles.push_back({imported.positions[t[0]], imported.positions[t[1]], imported.positions[t[2]]});
    return model;
}

Model modelFrom(const std::string& name) {
    if (name.starts_with("builtin:")) {
        auto made = brittle::makeBuiltin(name.substr(8));
        EXPECT_TRUE(made) << made.error().message;
        return modelFrom(*made);
    }
    auto imported = brittle::importMesh(support::sharedMesh(name));
    EXPECT_TRUE(imported) << imported.error().message;
    Model model = modelFrom(*imported);
    model.triangles = reference::readModel(support::sharedMesh(name).string());
    return model;
}

reference::FragmentFile exported(const brittle::FragmentSet& fragments) {
    const auto bytes = brittle::encodeGlb(fragments);
    EXPECT_TRUE(bytes) << bytes.error().message;
    const std::string path = testing::TempDir() + "brittle_contract.glb";
    std::ofstream(path, std::ios::binary) << *bytes;
    return reference::readFragmentFile(path);
}

void expectCountsAddUp(const FractureResult& result) {
    const brittle::FractureCounts& c = result.counts;
    EXPECT_EQ(c.sites_used + c.sites_welded, c.sites_requested);
    EXPECT_EQ(c.cells_ok + c.cells_empty + c.cells_refused, c.sites_used);
    EXPECT_EQ(result.sites.size(), c.sites_used);
    EXPECT_GE(result.fragments.fragments.size(), c.cells_ok);
}

void expectContract(const Model& model, const FractureOptions& options) {
    const auto result = shared_fracture.get().shatter(model.prepared.mesh, model.prepared.topology, options);
    ASSERT_TRUE(result) << result.error().message;
    expectCountsAddUp(*result);
    const brittle::MeshMeasures measures = brittle::inspectMesh(model.prepared.mesh, model.prepared.topology).measures;
    const auto own = brittle::verifyContract(model.prepared.mesh, measures, result->fragments, result->sites);
    EXPECT_TRUE(own.holds()) << own.violation();
    const reference::ContractReport report = reference::checkContract(exported(result->fragments), model.triangles);
    EXPECT_TRUE(report.holds()) << report.text();
}

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

// Bisectors in the faces of the model: a cube split by a lattice whose planes are the cube's own.
TEST(FractureTies, LatticesInAndThroughTheFacesOfACube) {
    const Model cube = modelFrom("builtin:cube");
    for (const double step : {1.0, 0.5, 0.25}) {
        SCOPED_TRACE(step);
        FractureOptions options;
        for (double x = -1; x <= 1; x += step)
            for (double y = -1; y <= 1; y += step)
                for (double z = -1; z <= 1; z += step)
                    options.given_sites.push_back({x, y, z});
        expectContract(cube, options);
    }
}

TEST(FractureTies, SitesInOnePlaneAndOutsideTheModel) {
    const Model cube = modelFrom("builtin:cube");
    FractureOptions options;
    for (int k = 0; k < 20; ++k)
        options.given_sites.push_back({-1.5 + 0.15 * k, 0.1 * (k % 3), 0});
    expectContract(cube, options);
}

TEST(FractureLimits, ManyCellsInAFewTriangles) {
    FractureOptions options;
    options.site_count = 2000;
    expectContract(modelFrom("builtin:cube"), options);
}

TEST(FractureLimits, ACellWithThreeHundredFaces) {
    const Model cube = modelFrom("builtin:cube");
    expectContract(cube, sitesOver(hard::sphereAroundCenter(300, .2), cube));
}

TEST(FractureLimits, ACellWithTwoThousandFaces) {
    const Model cube = modelFrom("builtin:cube");
    expectContract(cube, sitesOver(hard::sphereAroundCenter(2000, .3), cube));
}

// Many faces of one cell meet in one triangle, whose polygon there has as many sides.
TEST(FractureLimits, APolygonOfManySides) {
    const Model cube = modelFrom("builtin:cube");
    FractureOptions options;
    options.given_sites = {{0, 0, 0}};
    for (int k = 0; k < 200; ++k)
        options.given_sites.push_back({0.3 * std::cos(0.0314159 * k), 0.3 * std::sin(0.0314159 * k), 0});
    expectContract(cube, options);
}

TEST(FractureLimits, TwentyThousandCellsInACube) {
    FractureOptions options;
    options.site_count = 20'000;
    expectContract(modelFrom("builtin:cube"), options);
}

// The lists of the later stages would not fit.
TEST(FractureLimits, AHundredThousandCellsAlone) {
    const Model cube = modelFrom("builtin:cube");
    FractureOptions options;
    options.site_count = 100'000;
    options.only_cells = true;
    const auto result = shared_fracture.get().shatter(cube.prepared.mesh, cube.prepared.topology, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->counts.sites_used + result->counts.sites_welded, 100'000u);
    EXPECT_TRUE(result->fragments.fragments.empty());
}

TEST(LongFractureLimits, FiftyThousandCellsInACube) {
    FractureOptions options;
    options.site_count = 50'000;
    expectContract(modelFrom("builtin:cube"), options);
}

TEST(LongFractureLimits, AModelOfManyTriangles) {
    FractureOptions options;
    options.site_count = 100;
    expectContract(modelFrom("builtin:bumpy:7"), options); // 327,680 triangles
}

Model hollowSphere(uint32_t level) {
    using namespace brittle;
    using namespace support;
    return modelFrom(makeIcosphere(level) + turnedOver(moved(makeIcosphere(level), 0.9, {0, 0, 0})));
}

void expectContractOf(const Model& model, std::initializer_list<uint32_t> site_counts) {
    for (const uint32_t count : site_counts) {
        SCOPED_TRACE(count);
        FractureOptions options;
        options.site_count = count;
        expectContract(model, options);
    }
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

// A body-centered lattice over the unit cube: walls of hollows lie in bisectors, to within a step of the grid.
FractureOptions centeredLattice() {
    FractureOptions options;
    for (int x = 0; x <= 6; ++x)
        for (int y = 0; y <= 6; ++y)
            for (int z = 0; z <= 6; ++z)
                for (const double shift : {-0.5, -0.5 + 1.0 / 12})
                    options.given_sites.push_back({x / 6.0 + shift, y / 6.0 + shift, z / 6.0 + shift});
    return options;
}

brittle::ImportedMesh boxOf(const brittle::Double3& lower, const brittle::Double3& upper) {
    brittle::ImportedMesh box = brittle::makeCube();
    for (brittle::Double3& p : box.positions)
        for (size_t k = 0; k < 3; ++k)
            p[k] = p[k] < 0 ? lower[k] : upper[k];
    return box;
}

TEST(FractureTies, WallsOfHollowsInBisectors) {
    using namespace support;
    const brittle::ImportedMesh outside = boxOf({-.5, -.5, -.5}, {.5, .5, .5});
    for (const auto& [lower, upper] : {std::pair{-.25, .25}, std::pair{-1. / 3, 0.}, std::pair{-.2, .1}})
        expectContract(modelFrom(outside + turnedOver(boxOf({lower, lower, lower}, {upper, upper, upper}))), centeredLattice());
}

TEST(FractureTies, ThinPlates) {
    for (const double thickness : {1e-2, 1e-4, 1e-6}) {
        SCOPED_TRACE(thickness);
        const Model plate = modelFrom(boxOf({-.5, -.5, 0}, {.5, .5, thickness}));
        expectContract(plate, centeredLattice());
        expectContractOf(plate, {2, 150});
    }
}

// More triangles around the hollow than one lane may walk.
TEST(FractureLimits, AHollowModelOfManyTriangles) { expectContractOf(hollowSphere(6), {1, 3}); }

TEST(FractureRefuses, NoSitesAndSitesFarAway) {
    const Model cube = modelFrom("builtin:cube");
    FractureOptions options;
    options.site_count = 0;
    EXPECT_FALSE(shared_fracture.get().shatter(cube.prepared.mesh, cube.prepared.topology, options));
    options.given_sites = {{0, 0, 0}, {1e9, 0, 0}};
    const auto result = shared_fracture.get().shatter(cube.prepared.mesh, cube.prepared.topology, options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, engine::ErrorCode::BadInput);
}

TEST(FractureRefuses, MoreCellsThanTheDeviceCanBind) {
    const Model cube = modelFrom("builtin:cube");
    FractureOptions options;
    options.site_count = 1 << 24;
    const auto result = shared_fracture.get().shatter(cube.prepared.mesh, cube.prepared.topology, options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, engine::ErrorCode::Capacity) << result.error().message;
}

TEST(FractureRepeats, TheSameBytesEveryTime) {
    const Model ring = modelFrom("builtin:ring");
    FractureOptions options;
    options.site_count = 50;
    std::string first;
    for (int run = 0; run < 3; ++run) {
        const auto result = shared_fracture.get().shatter(ring.prepared.mesh, ring.prepared.topology, options);
        ASSERT_TRUE(result) << result.error().message;
        const auto bytes = brittle::encodeGlb(result->fragments);
        ASSERT_TRUE(bytes);
        if (run == 0) first = *bytes;
        EXPECT_TRUE(*bytes == first);
    }
}

} // namespace
