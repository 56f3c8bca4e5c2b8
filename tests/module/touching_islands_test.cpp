// Solids that touch only along edges or corners come apart: no fragment holds parts of two of them.
#include "modules/brittle/mesh/primitives.h"
#include "modules/brittle/mesh/topology.h"
#include "tests/module/whole_fracture.h"
#include "tests/support/solids.h"

#include <gtest/gtest.h>

namespace {

using namespace whole;
using brittle::Double3;
using support::moved;
using brittle::operator+;
using support::operator+;

// Two pyramids on one square base, as wide as 2 * half.
brittle::ImportedMesh bipyramid(double half) {
    brittle::ImportedMesh solid;
    solid.positions = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}, {0, 0, 0.4}, {0, 0, -0.4}};
    for (uint32_t k = 0; k < 4; ++k) {
        const uint32_t next = (k + 1) % 4;
        solid.triangles.push_back({k, next, 4});
        solid.triangles.push_back({next, k, 5});
    }
    solid.corner_normals.resize(3 * solid.triangles.size());
    solid.corner_uvs.resize(3 * solid.triangles.size());
    return solid;
}

// A square frame whose hole has a ridge all round, which the bipyramid touches along its four edges.
brittle::ImportedMesh frameAround(double half) {
    brittle::ImportedMesh frame;
    const std::array<std::array<double, 2>, 5> profile = {{{half, 0}, {1, 0.6}, {2, 0.6}, {2, -0.6}, {1, -0.6}}}; // radius, z
    for (const auto& [radius, z] : profile)
        for (const auto& [x, y] : {std::array{-1, -1}, std::array{1, -1}, std::array{1, 1}, std::array{-1, 1}})
            frame.positions.push_back({radius * x, radius * y, z});
    const auto at = [](uint32_t p, uint32_t k) { return 4 * (p % 5) + k % 4; };
    for (uint32_t p = 0; p < 5; ++p)
        for (uint32_t k = 0; k < 4; ++k) {
            frame.triangles.push_back({at(p, k), at(p + 1, k), at(p + 1, k + 1)});
            frame.triangles.push_back({at(p, k), at(p + 1, k + 1), at(p, k + 1)});
        }
    frame.corner_normals.resize(3 * frame.triangles.size());
    frame.corner_uvs.resize(3 * frame.triangles.size());
    return frame;
}

size_t fragmentsOf(const brittle::ImportedMesh& solid, const std::vector<Double3>& sites) {
    brittle::FractureOptions options;
    options.given_sites = sites;
    const Model model = modelFrom(solid);
    const auto result = fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
    if (!result) throw std::runtime_error(result.error().message);
    expectContract(model, *result);
    return result->fragments.fragments.size();
}

std::vector<Double3> sitesAbout(const Double3& middle, uint32_t count) {
    std::vector<Double3> sites;
    for (uint32_t k = 0; k < count; ++k)
        sites.push_back(middle + Double3{0.37 * (k % 3) - 0.31, 0.41 * (k / 3 % 3) - 0.42, 0.29 * (k / 9) - 0.3});
    return sites;
}

void expectApart(const brittle::ImportedMesh& a, const brittle::ImportedMesh& b) {
    for (const uint32_t count : {1u, 2u, 5u, 27u}) {
        const std::vector<Double3> sites = sitesAbout({0.5, 0.5, 0}, count);
        EXPECT_EQ(fragmentsOf(a + b, sites), fragmentsOf(a, sites) + fragmentsOf(b, sites)) << count << " sites";
    }
}

} // namespace

TEST(TouchingIslands, OfCubesThatShareAnEdgeOrACorner) {
    const brittle::ImportedMesh cube = brittle::makeCube();
    expectApart(cube, moved(cube, 1, {1, 1, 0}));
    expectApart(cube, moved(cube, 1, {1, 1, 1}));
}

TEST(TouchingIslands, OfASolidThatTouchesAnotherAllAround) { expectApart(frameAround(0.5), bipyramid(0.5)); }

// Turned, the ends of an edge differ by the last digit of a float, but not on the grid.
TEST(TouchingIslands, OfBlocksCornerToCornerThatAreTurned) {
    for (uint32_t turn = 0; turn < 12; ++turn) {
        const double c = std::cos(0.37 * turn), s = std::sin(0.37 * turn);
        brittle::ImportedMesh row;
        for (uint32_t k = 0; k < 5; ++k)
            row = row + moved(brittle::makeCube(), 0.7, {0.7 * k, 0.7 * k, 0});
        for (Double3& p : row.positions)
            p = {static_cast<float>(c * p[0] - s * p[2]), static_cast<float>(p[1]), static_cast<float>(s * p[0] + c * p[2])};
        EXPECT_EQ(fragmentsOf(row, {{0.1, 0.2, 0.3}}), 5u) << turn;
    }
}

// Their edges lie on each other in part: no vertex of one is a vertex of the other.
TEST(TouchingIslands, OfBlocksWhoseEdgesHaveOtherEnds) {
    const brittle::ImportedMesh cube = brittle::makeCube();
    const brittle::ImportedMesh pair = cube + moved(cube, 1, {1, 1, 0.5}),
                                four = pair + moved(cube, 1, {1, 0, 2.1}) + moved(cube, 1, {0, 1, -2.3});
    for (uint32_t seed = 1; seed <= 8; ++seed)
        for (const brittle::ImportedMesh* solid : {&pair, &four}) {
            brittle::FractureOptions options;
            options.site_count = 150;
            options.seed = seed;
            const Model model = modelFrom(*solid);
            const auto result = fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
            ASSERT_TRUE(result) << result.error().message;
            expectContract(model, *result);
            for (size_t f = 0; f < result->fragments.fragments.size(); ++f)
                EXPECT_FALSE(brittle::touchesItself(modelFrom(result->fragments, f).prepared.topology)) << seed << ", " << f;
        }
}
