// Colliders: a convex piece for every fragment, in its cell, around the fragment, apart from all others.
#include "modules/brittle/mesh/primitives.h"
#include "tests/engine/test_device.h"
#include "tests/module/collided.h"
#include "tests/support/shared_meshes.h"
#include "tests/support/solids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace {

using brittle::Double3;
using brittle::FractureOptions;
using brittle::ImportedMesh;
using support::operator+;

constexpr uint32_t kDirections[] = {6, 14, 26, 62};

FractureOptions sites(uint32_t count, uint64_t seed = 1) {
    FractureOptions options;
    options.site_count = count;
    options.seed = seed;
    return options;
}

FractureOptions given(std::vector<Double3> places) {
    FractureOptions options;
    options.given_sites = std::move(places);
    return options;
}

FractureOptions lattice(int across, double apart) {
    FractureOptions options;
    const double middle = (across - 1) / 2.0;
    for (int z = 0; z < across; ++z)
        for (int y = 0; y < across; ++y)
            for (int x = 0; x < across; ++x)
                options.given_sites.push_back({(x - middle) * apart, (y - middle) * apart, (z - middle) * apart});
    return options;
}

// A box turned about z and then x, by angles that no fixed direction has.
ImportedMesh turnedBox(const Double3& lower, const Double3& upper) {
    ImportedMesh box = whole::boxOf(lower, upper);
    const double c = std::cos(0.37), s = std::sin(0.37), d = std::cos(0.61), t = std::sin(0.61);
    for (Double3& p : box.positions) {
        p = {c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
        p = {p[0], d * p[1] - t * p[2], t * p[1] + d * p[2]};
    }
    return box;
}

// Two rings of a chain: one about z, the other turned, its center in the middle of the first one's tube.
ImportedMesh twoLinks() {
    const auto ring = brittle::makeBuiltin("ring");
    EXPECT_TRUE(ring);
    double inside = 1e30, outside = 0;
    for (const Double3& p : ring->positions) {
        inside = std::min(inside, std::hypot(p[0], p[1]));
        outside = std::max(outside, std::hypot(p[0], p[1]));
    }
    ImportedMesh other = *ring;
    for (Double3& p : other.positions)
        p = {p[1] + (inside + outside) / 2, p[2], p[0]};
    return *ring + other;
}

brittle::FractureResult expectColliders(uint32_t directions, const whole::Model& model, const FractureOptions& options) {
    SCOPED_TRACE(std::to_string(directions) + " directions");
    auto result = whole::brokenWith(directions, model, options);
    whole::expectColliders(model, result);
    return result;
}

template <class T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool sameBytes(const brittle::ColliderSet& a, const brittle::ColliderSet& b) {
    return sameBytes(a.pieces, b.pieces) && sameBytes(a.faces, b.faces) && sameBytes(a.vertices, b.vertices) &&
           sameBytes(a.corners, b.corners) && sameBytes(a.overlapping, b.overlapping);
}

TEST(SmallCollider, OfACubeInEightIsEveryFragmentItself) {
    const whole::Model cube = whole::modelFrom("builtin:cube");
    const auto result = expectColliders(26, cube, sites(8));
    EXPECT_NEAR(whole::excessOf(result.fragments), 0, 1e-6);
}

TEST(SmallCollider, PartsIslands) {
    const ImportedMesh two = turnedBox({-1, -1, -1}, {1, 1, -.05}) + turnedBox({-1, -1, .05}, {1, 1, 1});
    const whole::Model model = whole::modelFrom(two);
    const auto result = expectColliders(14, model, given({{0, 0, 0}}));
    EXPECT_EQ(result.fragments.fragments.size(), 2u);
    EXPECT_TRUE(result.fragments.colliders.overlapping.empty());
}

TEST(Collider, HoldsItsFragmentAndStaysInItsCell) {
    for (const char* name : {"builtin:ring", "builtin:bumpy:3"}) {
        SCOPED_TRACE(name);
        const whole::Model model = whole::modelFrom(name);
        for (const uint32_t directions : kDirections)
            expectColliders(directions, model, sites(60));
    }
}

TEST(Collider, GrowsTighterWithMoreDirections) {
    for (const char* name : {"builtin:ring", "builtin:bumpy:4", "builtin:icosphere:3"}) {
        SCOPED_TRACE(name);
        const whole::Model model = whole::modelFrom(name);
        double before = 1e30;
        for (const uint32_t directions : kDirections) {
            const double excess = whole::excessOf(whole::brokenWith(directions, model, sites(40)).fragments);
            EXPECT_LT(excess, before) << directions;
            EXPECT_GT(excess, 0);
            before = excess;
        }
    }
}

TEST(Collider, OfConvexFragmentsIsTheFragment) {
    const whole::Model sphere = whole::modelFrom("builtin:icosphere:1"), cube = whole::modelFrom("builtin:cube");
    const whole::Model turned = whole::modelFrom(turnedBox({-1, -.7, -.4}, {1, .7, .4}));
    for (const whole::Model* model : {&sphere, &cube, &turned}) {
        const auto result = expectColliders(6, *model, sites(model == &sphere ? 12 : 60));
        EXPECT_NEAR(whole::excessOf(result.fragments), 0, 1e-6);
        for (const brittle::ColliderPiece& piece : result.fragments.colliders.pieces)
            EXPECT_EQ(piece.lacks, 0u);
    }
}

TEST(Collider, SaysWhereAConvexFragmentHasMorePlanesThanAreLookedFor) {
    const whole::Model sphere = whole::modelFrom("builtin:icosphere:3");
    const auto result = expectColliders(62, sphere, sites(4));
    for (const brittle::ColliderPiece& piece : result.fragments.colliders.pieces)
        EXPECT_NE(piece.lacks & brittle::kLacksSurfaces, 0u);
}

TEST(Collider, OfDegenerateSitesHasNoFlaw) {
    const whole::Model cube = whole::modelFrom("builtin:cube"), bumpy = whole::modelFrom("builtin:bumpy:3");
    for (const FractureOptions& options : {lattice(4, .25), lattice(5, .25), lattice(3, .5)}) {
        const auto result = expectColliders(26, cube, options);
        EXPECT_NEAR(whole::excessOf(result.fragments), 0, 1e-6);
        expectColliders(62, bumpy, options);
    }
}

// The sphere around a site whose neighbors lie on a sphere has no corner that only three planes meet in.
TEST(Collider, OfASiteInTheMiddleOfManyOthersIsItsCell) {
    std::vector<Double3> places = {{0, 0, 0}};
    const auto sphere = brittle::makeBuiltin("icosphere:1");
    ASSERT_TRUE(sphere);
    for (const Double3& p : sphere->positions)
        places.push_back({.4 * p[0], .4 * p[1], .4 * p[2]});
    const whole::Model cube = whole::modelFrom("builtin:cube");
    const auto result = expectColliders(62, cube, given(places));
    EXPECT_NEAR(whole::excessOf(result.fragments), 0, 1e-6);
}

// More planes than a piece can have: it keeps what it has, and says so.
TEST(Collider, OfACellWithManyFacesSaysWhatItLacks) {
    std::vector<Double3> places = {{0, 0, 0}};
    const auto sphere = brittle::makeBuiltin("icosphere:3");
    ASSERT_TRUE(sphere);
    for (const Double3& p : sphere->positions)
        places.push_back({.4 * p[0], .4 * p[1], .4 * p[2]});
    const whole::Model cube = whole::modelFrom("builtin:cube");
    const auto result = whole::brokenWith(26, cube, given(places));
    const auto& set = result.fragments;
    ASSERT_EQ(set.colliders.pieces.size(), places.size());
    for (uint32_t f = 0; f < set.fragments.size(); ++f) {
        EXPECT_EQ(reference::defectOf(whole::convexOf(set.colliders, f), 1e-6), "");
        EXPECT_EQ((set.colliders.pieces[f].lacks & brittle::kLacksCell) != 0, set.fragments[f].cell == 0) << f;
    }
}

TEST(Collider, PartsIslandsOfACell) {
    ImportedMesh comb = whole::boxOf({-4, -1, -1.5}, {4, 1, -1});
    for (int tooth = -4; tooth < 4; ++tooth)
        comb = comb + whole::boxOf({double(tooth), -1, -.9}, {tooth + .5, 1, 1});
    const auto result = expectColliders(6, whole::modelFrom(comb), given({{0, 0, 0}}));
    EXPECT_EQ(result.fragments.fragments.size(), 9u);
    EXPECT_TRUE(result.fragments.colliders.overlapping.empty());
}

// Between plates that lie close together and at an angle no fixed direction finds a way.
TEST(Collider, PartsIslandsAlongPlanesOfTheirOwn) {
    ImportedMesh plates = turnedBox({-1, -1, -1}, {1, 1, -.8});
    for (int k = 1; k < 6; ++k)
        plates = plates + turnedBox({-1, -1, -1 + .21 * k}, {1, 1, -.8 + .21 * k});
    const whole::Model model = whole::modelFrom(plates);
    for (const uint32_t directions : kDirections) {
        const auto result = expectColliders(directions, model, given({{0, 0, 0}}));
        EXPECT_EQ(result.fragments.fragments.size(), 6u);
        EXPECT_TRUE(result.fragments.colliders.overlapping.empty());
    }
}

TEST(Collider, ListsIslandsThatNoPlaneParts) {
    const ImportedMesh shell = brittle::makeCube() + support::turnedOver(support::moved(brittle::makeCube(), .8, {0, 0, 0}));
    const whole::Model nested = whole::modelFrom(shell + support::moved(brittle::makeCube(), .5, {0, 0, 0}));
    const whole::Model links = whole::modelFrom(twoLinks());
    for (const whole::Model* model : {&nested, &links}) {
        const auto result = expectColliders(26, *model, given({{0, 0, 0}}));
        ASSERT_EQ(result.fragments.fragments.size(), 2u);
        EXPECT_EQ(result.fragments.colliders.overlapping, (std::vector<std::array<uint32_t, 2>>{{0, 1}}));
    }
}

// 343 islands in one cell are more pieces, and more pairs, than there is room for at first.
TEST(Collider, FindsRoomForManyIslands) {
    ImportedMesh cubes = support::moved(brittle::makeCube(), .5, {0, 0, 0});
    for (int k = 1; k < 343; ++k)
        cubes = cubes + support::moved(brittle::makeCube(), .5, {double(k % 7), double(k / 7 % 7), std::floor(k / 49.)});
    const auto result = expectColliders(6, whole::modelFrom(cubes), given({{3, 3, 3}}));
    EXPECT_EQ(result.fragments.fragments.size(), 343u);
    EXPECT_NEAR(whole::excessOf(result.fragments), 0, 1e-6);
}

TEST(Collider, IsMadeOfFragmentsThatBreakAgain) {
    const whole::Model bumpy = whole::modelFrom("builtin:bumpy:3");
    const auto first = whole::brokenWith(26, bumpy, sites(12));
    for (const size_t fragment : {size_t{0}, size_t{5}}) {
        const whole::Model piece = whole::modelFrom(first.fragments, fragment);
        expectColliders(26, piece, sites(20));
    }
}

TEST(Collider, IsTheSameEveryTimeAndInWorkgroupsOfAnySize) {
    const whole::Model model = whole::modelFrom("builtin:ring");
    FractureOptions options = sites(100);
    options.collider = 26;
    const auto usual = whole::brokenWith(26, model, options);
    EXPECT_TRUE(sameBytes(usual.fragments.colliders, whole::brokenWith(26, model, options).fragments.colliders));
    for (const uint32_t size : {8u, 128u}) {
        auto fracture = brittle::Fracture::create(engine_test::device(), size);
        ASSERT_TRUE(fracture);
        const auto result = (*fracture)->shatter(model.prepared.mesh, model.prepared.topology, options);
        ASSERT_TRUE(result);
        EXPECT_TRUE(sameBytes(usual.fragments.colliders, result->fragments.colliders)) << size;
    }
}

TEST(Collider, CostsNothingWhereNoneIsAskedFor) {
    const whole::Model model = whole::modelFrom("builtin:cube");
    FractureOptions options = sites(20);
    options.time_kernels = true;
    const auto without = whole::brokenWith(0, model, options), with = whole::brokenWith(6, model, options);
    EXPECT_TRUE(without.fragments.colliders.pieces.empty());
    EXPECT_TRUE(sameBytes(without.fragments.vertices, with.fragments.vertices));
    const auto has = [](const brittle::FractureResult& result, const char* name) {
        return std::ranges::any_of(result.timings, [&](const engine::Timing& t) { return t.name == name; });
    };
    for (const char* kernel : {"list_fragments", "measure_supports_6", "take_surfaces", "cut_colliders", "emit_colliders"}) {
        EXPECT_FALSE(has(without, kernel)) << kernel;
        EXPECT_TRUE(has(with, kernel)) << kernel;
    }
}

TEST(Collider, OfAnUnbrokenObjectIsACompoundOfItsCells) {
    const whole::Model ring = whole::modelFrom("builtin:ring");
    const auto result = whole::brokenWith(26, ring, sites(30));
    const brittle::ColliderBody whole_body = brittle::wholeBody(result.fragments.colliders);
    EXPECT_EQ(whole_body.first_piece, 0u);
    EXPECT_EQ(whole_body.piece_count, result.fragments.fragments.size());
    const auto one = brittle::bodyOf(result.fragments.colliders, 7);
    ASSERT_TRUE(one);
    EXPECT_EQ(one->first_piece, 7u);
    EXPECT_EQ(one->piece_count, 1u);
    EXPECT_FALSE(brittle::bodyOf(result.fragments.colliders, whole_body.piece_count));
}

TEST(LongCollider, OfRealModelsHasNoFlaw) {
    SKIP_WITHOUT_MESHES();
    for (const char* name : {"goblet-Vase.stl", "fandisk.off", "cheese.off", "gearwheel.bin.stl", "torus.obj", "trefoil.obj"}) {
        SCOPED_TRACE(name);
        const whole::Model model = whole::modelFrom(name);
        for (const uint32_t count : {12u, 80u})
            expectColliders(26, model, sites(count));
    }
}

TEST(Collider, TakesOnlyTheDirectionsThereAre) {
    const whole::Model cube = whole::modelFrom("builtin:cube");
    FractureOptions options = sites(4);
    options.collider = 7;
    const auto refused = whole::fracture().shatter(cube.prepared.mesh, cube.prepared.topology, options);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, engine::ErrorCode::BadInput);
}

} // namespace
