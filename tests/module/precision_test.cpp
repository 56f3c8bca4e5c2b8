// Less than exact signs: the same fragments where nothing ties, and where something does an error or fragments that fail their
// check, but nothing worse. The exact ones do not change by it.
#include "engine/reflection.h"
#include "modules/brittle/export/glb.h"
#include "modules/brittle/fracture/verify.h"
#include "modules/brittle/mesh/check.h"
#include "shaders-spirv/shared/fracture.h"
#include "tests/engine/test_device.h"
#include "tests/module/whole_fracture.h"
#include "tests/support/shared_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using brittle::FractureOptions;
using brittle::Precision;

FractureOptions sites(uint32_t count, Precision precision) {
    FractureOptions options;
    options.site_count = count;
    options.precision = precision;
    return options;
}

// Ties everywhere, on the model's faces too where `reach` is half its size.
FractureOptions lattice(uint32_t side, double reach, Precision precision) {
    FractureOptions options;
    options.precision = precision;
    const auto at = [&](uint32_t k) { return reach * (2.0 * k / (side - 1) - 1); };
    for (uint32_t x = 0; x < side; ++x)
        for (uint32_t y = 0; y < side; ++y)
            for (uint32_t z = 0; z < side; ++z)
                options.given_sites.push_back({at(x), at(y), at(z)});
    return options;
}

engine::Result<brittle::FractureResult> broken(const whole::Model& model, const FractureOptions& options) {
    return whole::fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
}

std::string bytesOf(const whole::Model& model, const FractureOptions& options) {
    const auto result = broken(model, options);
    EXPECT_TRUE(result) << result.error().message;
    const auto bytes = result ? brittle::encodeGlb(result->fragments) : engine::Result<std::string>(result.error());
    return bytes ? *bytes : "";
}

// Fragments, whatever they are worth, or an error that says what to do about it.
void expectAnEnd(const whole::Model& model, const FractureOptions& options) {
    const auto result = broken(model, options);
    if (!result) {
        EXPECT_NE(result.error().message.find("use exact"), std::string::npos) << result.error().message;
        std::printf("%s: %s\n", nameOf(options.precision), result.error().message.c_str());
        return;
    }
    const brittle::MeshReport report = brittle::inspectMesh(model.prepared.mesh, model.prepared.topology);
    const auto contract = brittle::verifyContract(model.prepared.mesh, report.measures, result->fragments, result->sites);
    std::printf("%s: %zu fragments %s\n", nameOf(options.precision), result->fragments.fragments.size(),
                contract.violation().c_str());
}

// Under the validation layers a driver takes minutes to compile a precision: one is enough there.
TEST(SmallPrecision, OfTiesComesToAnEnd) { expectAnEnd(whole::modelFrom("builtin:cube"), lattice(3, .5, Precision::Fast)); }

TEST(Precision, OfTiesComesToAnEnd) {
    for (const char* name : {"builtin:cube", "builtin:icosphere:2", "builtin:bumpy:3", "builtin:ring"}) {
        SCOPED_TRACE(name);
        const whole::Model model = whole::modelFrom(name);
        for (const Precision precision : {Precision::Double, Precision::Fast})
            for (const double reach : {.5, .375, .61803})
                for (const uint32_t side : {2u, 5u, 8u})
                    expectAnEnd(model, lattice(side, reach, precision));
    }
}

TEST(Precision, OfRealModelsComesToAnEnd) {
    SKIP_WITHOUT_MESHES();
    for (const char* name : {"fandisk.off", "gearwheel.bin.stl", "hundred_cubes.obj", "spot_low_resolution.obj"}) {
        SCOPED_TRACE(name);
        const whole::Model model = whole::modelFrom(name);
        for (const Precision precision : {Precision::Double, Precision::Fast})
            for (const uint32_t count : {30u, 1000u})
                expectAnEnd(model, sites(count, precision));
    }
}

TEST(Precision, DoesNotShowWhereNothingTies) {
    for (const char* name : {"builtin:bumpy:4", "builtin:ring"}) {
        SCOPED_TRACE(name);
        const whole::Model model = whole::modelFrom(name);
        const auto exact = broken(model, sites(80, Precision::Exact));
        ASSERT_TRUE(exact) << exact.error().message;
        for (const Precision precision : {Precision::Double, Precision::Fast}) {
            SCOPED_TRACE(nameOf(precision));
            const auto result = broken(model, sites(80, precision));
            ASSERT_TRUE(result) << result.error().message;
            EXPECT_EQ(result->fragments.fragments.size(), exact->fragments.fragments.size());
            EXPECT_EQ(result->fragments.indices.size(), exact->fragments.indices.size());
            whole::expectContract(model, *result);
        }
    }
}

// Each precision has buffers of its own: those of a break with exact signs would still hold its values.
void expectAsExact(const whole::Model& model, FractureOptions options, const Precision precision) {
    SCOPED_TRACE(nameOf(precision));
    options.precision = Precision::Exact;
    const auto exact = broken(model, options);
    ASSERT_TRUE(exact) << exact.error().message;
    options.precision = precision;
    const auto fracture = brittle::Fracture::create(engine_test::device());
    ASSERT_TRUE(fracture) << fracture.error().message;
    const auto result = (*fracture)->shatter(model.prepared.mesh, model.prepared.topology, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->fragments.fragments.size(), exact->fragments.fragments.size());
    EXPECT_EQ(result->fragments.indices.size(), exact->fragments.indices.size());
    whole::expectContract(model, *result);
}

TEST(Precision, DoesNotShowInAFirstBreak) {
    const whole::Model model = whole::modelFrom("builtin:bumpy:3");
    for (const Precision precision : {Precision::Double, Precision::Fast})
        expectAsExact(model, sites(60, precision), precision);
}

// A section of the model has 300 sides and more.
TEST(Precision, DoesNotShowInFacesOfManySides) {
    const whole::Model model = whole::modelFrom("builtin:bumpy:5");
    for (const Precision precision : {Precision::Double, Precision::Fast})
        expectAsExact(model, sites(2, precision), precision);
}

// The cell in the middle has 200 sides; no two of its neighbors are as far away as each other.
TEST(Precision, DoesNotShowInCellsOfManySides) {
    const whole::Model cube = whole::modelFrom("builtin:cube");
    FractureOptions options;
    options.given_sites = {{0.01, 0.02, 0}};
    for (int k = 0; k < 200; ++k) {
        const double angle = 0.0314159 * k + 0.0005 * (k % 7), radius = 0.3 + 0.0001 * (k % 5);
        options.given_sites.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.001 * (k % 3)});
    }
    expectAsExact(cube, options, Precision::Double);
}

TEST(Precision, OfOthersDoesNotShowInExactFragments) {
    const whole::Model model = whole::modelFrom("builtin:bumpy:3");
    const std::string exact = bytesOf(model, sites(60, Precision::Exact));
    EXPECT_FALSE(exact.empty());
    for (const Precision precision : {Precision::Double, Precision::Fast})
        EXPECT_FALSE(bytesOf(model, sites(60, precision)).empty());
    EXPECT_TRUE(bytesOf(model, sites(60, Precision::Exact)) == exact);
}

TEST(Precision, OfDoublesIsRefusedWhereTheDeviceHasNone) {
    const auto fracture = brittle::Fracture::create(engine_test::minimalDevice());
    ASSERT_TRUE(fracture) << fracture.error().message;
    const whole::Model cube = whole::modelFrom("builtin:cube");
    const auto refused = (*fracture)->shatter(cube.prepared.mesh, cube.prepared.topology, sites(5, Precision::Double));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, engine::ErrorCode::Device);
    EXPECT_NE(refused.error().message.find("64-bit floats"), std::string::npos) << refused.error().message;
    EXPECT_TRUE((*fracture)->shatter(cube.prepared.mesh, cube.prepared.topology, sites(5, Precision::Fast)));
}

TEST(Precision, IsKnownToEveryKernelThatDecides) {
    const auto modules = shaders::all();
    const auto isThere = [&](const std::string& name) {
        return std::ranges::count(modules, name, &shaders::Module::name) != 0;
    };
    size_t deciding = 0;
    for (const shaders::Module& module : modules) {
        const auto reflection = engine::reflect(module.words);
        ASSERT_TRUE(reflection);
        const bool decides = std::ranges::count(reflection->spec_ids, uint32_t{PRECISION_ID}) != 0;
        deciding += decides ? 1 : 0;
        EXPECT_EQ(decides, isThere(std::string(module.name) + "_double")) << module.name;
    }
    EXPECT_GT(deciding, 10u);
}

} // namespace
