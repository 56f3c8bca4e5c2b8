// Caps as fans (caps=convex): the contract holds where the surface is convex, and is found broken where it is not.
#include "modules/brittle/fracture/verify.h"
#include "modules/brittle/mesh/measures.h"
#include "tests/module/whole_fracture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using brittle::Caps;
using brittle::FractureOptions;
using brittle::FractureResult;
using brittle::Fragment;
using namespace whole;

FractureResult broken(const Model& model, FractureOptions options, Caps caps) {
    options.caps = caps;
    auto result = fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
    EXPECT_TRUE(result) << result.error().message;
    return result ? std::move(*result) : FractureResult{};
}

double cutAreaOf(const brittle::FragmentSet& set) {
    reference::Triangles cut;
    for (const Fragment& f : set.fragments)
        for (uint32_t k = f.outer_index_count; k < f.outer_index_count + f.inner_index_count; k += 3) {
            reference::Triangle& t = cut.emplace_back();
            for (uint32_t c = 0; c < 3; ++c)
                std::copy_n(set.vertices[f.first_vertex + set.indices[f.first_index + k + c]].position, 3, t[c].begin());
        }
    return reference::areaOf(cut);
}

// The same fragments as with caps=exact, but for the triangles of their caps.
void expectTheSameSolids(const Model& model, const FractureOptions& options) {
    const FractureResult convex = broken(model, options, Caps::Convex), exact = broken(model, options, Caps::Exact);
    expectContract(model, convex);
    const auto &ours = convex.fragments.fragments, &theirs = exact.fragments.fragments;
    ASSERT_EQ(ours.size(), theirs.size());
    const double area = cutAreaOf(exact.fragments), volume = reference::volumeOf(model.triangles);
    EXPECT_NEAR(cutAreaOf(convex.fragments), area, 1e-6 * area);
    for (size_t f = 0; f < ours.size(); ++f) {
        EXPECT_EQ(ours[f].cell, theirs[f].cell);
        EXPECT_EQ(ours[f].inner_index_count, theirs[f].inner_index_count);
        EXPECT_NEAR(ours[f].volume, theirs[f].volume, 1e-6 * volume);
    }
}

void expectTheSameSolids(const char* name, std::initializer_list<uint32_t> site_counts) {
    const Model model = modelFrom(std::string(name));
    for (const uint32_t count : site_counts) {
        SCOPED_TRACE(std::string(name) + " " + std::to_string(count));
        FractureOptions options;
        options.site_count = count;
        expectTheSameSolids(model, options);
    }
}

std::string violationOf(const Model& model, const FractureResult& result) {
    return brittle::verifyContract(model.prepared.mesh, brittle::measureMesh(model.prepared.mesh), result.fragments,
                                   result.sites)
        .violation();
}

TEST(SmallConvexCaps, HoldTheContractOnConvexModels) {
    expectTheSameSolids("builtin:cube", {1, 2, 10});
    expectTheSameSolids("builtin:icosphere:2", {2, 10, 100});
}

TEST(ConvexCaps, HoldTheContractOnConvexModels) {
    expectTheSameSolids("builtin:cube", {100, 1000});
    expectTheSameSolids("builtin:icosphere:0", {2, 10, 100, 1000});
    expectTheSameSolids("builtin:icosphere:4", {2, 10, 100, 1000});
}

// Bisectors in the faces of the cube, and cells that meet in its corners: opposite sides of caps cancel.
TEST(SmallConvexCaps, HoldTheContractWhereFacesLieInBisectors) {
    const Model cube = modelFrom("builtin:cube");
    for (const double apart : {0.25, 0.5, 1.0}) {
        SCOPED_TRACE(apart);
        FractureOptions options;
        for (double x = -0.75; x < 1; x += apart)
            for (double y = -0.75; y < 1; y += apart)
                for (double z = -0.75; z < 1; z += apart)
                    options.given_sites.push_back({x, y, z});
        options.caps = Caps::Convex;
        expectContract(cube, options);
        EXPECT_NEAR(cutAreaOf(broken(cube, options, Caps::Convex).fragments),
                    cutAreaOf(broken(cube, options, Caps::Exact).fragments), 1e-6);
    }
}

TEST(SmallConvexCaps, ComeOutTheSameEveryTime) {
    const Model model = modelFrom("builtin:icosphere:2");
    FractureOptions options;
    options.site_count = 12;
    const FractureResult first = broken(model, options, Caps::Convex);
    for (int run = 0; run < 3; ++run)
        EXPECT_EQ(broken(model, options, Caps::Convex).fragments.indices, first.fragments.indices);
}

TEST(SmallConvexCaps, AreFoundBrokenWhereTheSurfaceIsNotConvex) {
    const Model ring = modelFrom("builtin:ring");
    for (const uint32_t count : {2u, 10u, 100u}) {
        FractureOptions options;
        options.site_count = count;
        const std::string violation = violationOf(ring, broken(ring, options, Caps::Convex));
        EXPECT_NE(violation.find("turned over"), std::string::npos) << count << " sites: " << violation;
    }
}

// Whatever comes out: an answer, and no crash.
TEST(ConvexCaps, BreakNothingButTheContract) {
    for (const char* name : {"builtin:bumpy:4", "builtin:ring"})
        for (const uint32_t count : {2u, 30u, 1000u}) {
            FractureOptions options;
            options.site_count = count;
            EXPECT_FALSE(broken(modelFrom(std::string(name)), options, Caps::Convex).fragments.fragments.empty());
        }
}

} // namespace
