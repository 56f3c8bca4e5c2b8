// How cells are spread over the device is no part of the result.
#include "modules/brittle/export/glb.h"
#include "tests/module/whole_fracture.h"
#include "tests/support/shared_meshes.h"

#include <gtest/gtest.h>

namespace {

using brittle::CellMapping;
using brittle::FractureOptions;

std::string brokenBytes(const whole::Model& model, const FractureOptions& options) {
    const auto result = whole::fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
    EXPECT_TRUE(result) << result.error().message;
    const auto bytes = brittle::encodeGlb(result->fragments);
    EXPECT_TRUE(bytes) << bytes.error().message;
    return *bytes;
}

void expectTheSameByEdges(const whole::Model& model, FractureOptions options) {
    options.cells = CellMapping::Lanes;
    const std::string lanes = brokenBytes(model, options);
    EXPECT_FALSE(lanes.empty());
    options.cells = CellMapping::Edges;
    EXPECT_TRUE(brokenBytes(model, options) == lanes);
}

TEST(SmallCellMapping, DoesNotShowInFragments) {
    FractureOptions options;
    options.site_count = 40;
    expectTheSameByEdges(whole::modelFrom("builtin:icosphere:2"), options);
}

TEST(CellMapping, DoesNotShowInFragmentsOfRealModels) {
    SKIP_WITHOUT_MESHES();
    FractureOptions options;
    options.site_count = 300;
    for (const char* name : {"spot_low_resolution.obj", "fandisk.off"}) {
        SCOPED_TRACE(name);
        expectTheSameByEdges(whole::modelFrom(name), options);
    }
}

// Ties everywhere: the filter can decide next to nothing.
TEST(CellMapping, DoesNotShowInLattices) {
    FractureOptions options;
    for (double x : {-.375, -.125, .125, .375})
        for (double y : {-.375, -.125, .125, .375})
            for (double z : {-.375, -.125, .125, .375})
                options.given_sites.push_back({x, y, z});
    expectTheSameByEdges(whole::modelFrom("builtin:cube"), options);
}

TEST(CellMapping, DoesNotShowWhereSitesCrowdOrMove) {
    FractureOptions options;
    options.site_count = 200;
    options.relax = 1;
    expectTheSameByEdges(whole::modelFrom("builtin:bumpy:3"), options);
    options.relax = 0;
    options.pattern = brittle::Pattern::Impact;
    options.impact = {{0, 0, .5}, brittle::contactRadiusOf(3), brittle::favorOf(3)};
    expectTheSameByEdges(whole::modelFrom("builtin:bumpy:3"), options);
}

TEST(CellMapping, ByEdgesTakesNoOtherSearch) {
    const whole::Model cube = whole::modelFrom("builtin:cube");
    FractureOptions options;
    options.cells = CellMapping::Edges;
    for (const brittle::Search search : {brittle::Search::Linear, brittle::Search::SphereTree}) {
        options.search = search;
        const auto refused = whole::fracture().shatter(cube.prepared.mesh, cube.prepared.topology, options);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, engine::ErrorCode::BadInput);
        EXPECT_NE(refused.error().message.find("by grid only"), std::string::npos) << refused.error().message;
    }
}

} // namespace
