// Objects that are broken together come out as each does alone: their cells do not know of each other.
#include "modules/brittle/fracture/verify.h"
#include "modules/brittle/mesh/measures.h"
#include "modules/brittle/mesh/primitives.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/module/whole_fracture.h"
#include "tests/support/solids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace {

using brittle::BreakingObject, brittle::Double3, brittle::FractureOptions, brittle::FractureResult;

struct Broken {
    whole::Model model;
    std::vector<Double3> sites;
    FractureResult alone;
};

whole::Model scaledModel(const std::string& name, double scale, const Double3& place) {
    auto mesh = brittle::makeBuiltin(name);
    EXPECT_TRUE(mesh) << name;
    return whole::modelFrom(support::moved(*mesh, scale, place));
}

// Sites where the pattern puts them, then the object alone with these.
Broken broken(whole::Model model, uint32_t sites, const FractureOptions& how, uint64_t seed) {
    FractureOptions options = how;
    options.site_count = sites;
    options.seed = seed;
    const auto placed = whole::fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
    EXPECT_TRUE(placed) << placed.error().message;
    options.given_sites = placed->sites;
    auto alone = whole::fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
    EXPECT_TRUE(alone) << alone.error().message;
    return {std::move(model), placed->sites, std::move(*alone)};
}

std::vector<FractureResult> together(const std::vector<Broken>& objects, const FractureOptions& how = {}) {
    std::vector<BreakingObject> breaking;
    for (const Broken& object : objects)
        breaking.push_back({object.model.prepared.mesh, object.model.prepared.topology, object.sites});
    auto results = whole::fracture().shatterTogether(breaking, how);
    EXPECT_TRUE(results) << results.error().message;
    return results ? std::move(*results) : std::vector<FractureResult>();
}

std::multiset<double> volumes(const FractureResult& result) {
    std::multiset<double> all;
    for (const brittle::Fragment& f : result.fragments.fragments)
        all.insert(f.volume);
    return all;
}

void expectSame(const Broken& object, const FractureResult& result) {
    EXPECT_EQ(result.sites, object.alone.sites);
    EXPECT_EQ(result.fragments.fragments.size(), object.alone.fragments.fragments.size());
    EXPECT_EQ(whole::placesByCell(result), whole::placesByCell(object.alone));
    const auto here = volumes(result), there = volumes(object.alone);
    const double whole = brittle::measureMesh(object.model.prepared.mesh).volume;
    EXPECT_TRUE(std::ranges::equal(here, there, [&](double a, double b) { return std::abs(a - b) <= 1e-6 * whole; }));
    FractureResult bare = result; // the checker knows fragments and nothing else
    bare.fragments.colliders = {};
    whole::expectContract(object.model, bare);
}

void expectSameTogether(const std::vector<Broken>& objects, const FractureOptions& how = {}) {
    const auto results = together(objects, how);
    ASSERT_EQ(results.size(), objects.size());
    for (size_t k = 0; k < objects.size(); ++k) {
        SCOPED_TRACE(k);
        expectSame(objects[k], results[k]);
    }
}

TEST(SmallBatch, AnObjectAmongOthersBreaksAsItDoesAlone) {
    std::vector<Broken> objects;
    objects.push_back(broken(scaledModel("icosphere", 1, {0, 0, 0}), 20, {}, 1));
    objects.push_back(broken(scaledModel("ring", 1e-3, {5, 6, 7}), 33, {}, 2));
    objects.push_back(broken(scaledModel("icosphere", 3e5, {0, 1e7, 0}), 1, {}, 3));
    objects.push_back(broken(whole::modelFrom(whole::boxOf({0, 0, 0}, {1, 2, 0.01})), 15, {}, 4));
    expectSameTogether(objects);
}

TEST(SmallBatch, OneIsEnough) { expectSameTogether({broken(scaledModel("ring", 1, {0, 0, 0}), 50, {}, 5)}); }

TEST(Batch, TheSameObjectManyTimesBreaksTheSameEveryTime) {
    std::vector<Broken> objects;
    for (int k = 0; k < 17; ++k) // a second row of tiles
        objects.push_back(broken(scaledModel("icosphere", 1, {0, 0, 0}), 64, {}, 7));
    expectSameTogether(objects);
}

TEST(Batch, ColliderPiecesAreThoseOfEachAlone) {
    FractureOptions how;
    how.collider = 26;
    std::vector<Broken> objects;
    objects.push_back(broken(scaledModel("ring", 1, {0, 0, 0}), 30, how, 1));
    objects.push_back(broken(scaledModel("icosphere", 20, {3, 0, 0}), 40, how, 2));
    const auto results = together(objects, how);
    ASSERT_EQ(results.size(), 2u);
    for (size_t k = 0; k < 2; ++k) {
        expectSame(objects[k], results[k]);
        const brittle::ColliderSet &here = results[k].fragments.colliders, &alone = objects[k].alone.fragments.colliders;
        ASSERT_EQ(here.pieces.size(), alone.pieces.size());
        std::multiset<double> volume_here, volume_alone;
        for (const auto& piece : here.pieces)
            volume_here.insert(brittle::volumeOf(here, piece));
        for (const auto& piece : alone.pieces)
            volume_alone.insert(brittle::volumeOf(alone, piece));
        for (auto a = volume_here.begin(), b = volume_alone.begin(); a != volume_here.end(); ++a, ++b)
            EXPECT_NEAR(*a / *b, 1, 5e-3); // of many sides that are nearly flat, which are taken depends on their order
        EXPECT_EQ(here.overlapping.size(), alone.overlapping.size());
    }
}

// Fragments of fragments, with faces of earlier cuts.
TEST(Batch, FragmentsOfOneObjectBreakOnTogether) {
    const Broken first = broken(scaledModel("ring", 1, {0, 0, 0}), 6, {}, 3);
    std::vector<Broken> objects;
    for (size_t f = 0; f < first.alone.fragments.fragments.size(); ++f)
        objects.push_back(broken(whole::modelFrom(first.alone.fragments, f), 9, {}, f));
    const auto results = together(objects);
    ASSERT_EQ(results.size(), objects.size());
    for (size_t k = 0; k < objects.size(); ++k) {
        expectSame(objects[k], results[k]);
        uint32_t earlier = 0, earlier_alone = 0;
        for (const brittle::Fragment& f : results[k].fragments.fragments)
            earlier += f.earlier_index_count;
        for (const brittle::Fragment& f : objects[k].alone.fragments.fragments)
            earlier_alone += f.earlier_index_count;
        EXPECT_EQ(earlier, earlier_alone);
        EXPECT_GT(earlier, 0u);
    }
}

TEST(SmallBatch, SaysWhichObjectCannotBeBroken) {
    const whole::Model ball = scaledModel("icosphere", 1, {0, 0, 0});
    const BreakingObject good = {ball.prepared.mesh, ball.prepared.topology, {{0, 0, 0}}};
    const BreakingObject bare = {ball.prepared.mesh, ball.prepared.topology, {}};
    const BreakingObject far = {ball.prepared.mesh, ball.prepared.topology, {{0, 1e9, 0}}};
    const auto refusal = [&](std::initializer_list<BreakingObject> objects) {
        const auto results = whole::fracture().shatterTogether(objects, {});
        return results ? std::string() : results.error().message;
    };
    EXPECT_NE(refusal({good, bare}).find("object 2: has no sites"), std::string::npos);
    EXPECT_NE(refusal({far, good}).find("object 1: site 1"), std::string::npos);
    EXPECT_NE(refusal({}).find("0 objects"), std::string::npos);
}

} // namespace
