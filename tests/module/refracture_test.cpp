// Fragments that are broken again, and their fragments in turn.
#include "modules/brittle/fracture/refracture.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/module/whole_fracture.h"
#include "tests/support/shared_meshes.h"
#include "tests/support/solids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace {

using brittle::FractureOptions;
using brittle::Fragment;
using namespace whole;

enum class Choice : uint8_t { Largest, Random };

struct Descent {
    const char* model;
    Choice choice = Choice::Largest;
    uint64_t seed = 1;
};

std::string nameOf(const testing::TestParamInfo<Descent>& info) {
    std::string name = std::string(info.param.model) + (info.param.choice == Choice::Largest ? "_largest" : "_random") +
                       "_seed" + std::to_string(info.param.seed);
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

constexpr uint32_t kDepth = 8;

size_t chosen(const brittle::FragmentSet& set, Choice choice, std::mt19937& random) {
    if (choice == Choice::Random) return random() % set.fragments.size();
    const auto smaller = [](const Fragment& a, const Fragment& b) { return a.volume < b.volume; };
    return static_cast<size_t>(std::ranges::max_element(set.fragments, smaller) - set.fragments.begin());
}

class Refracture : public testing::TestWithParam<Descent> {};

TEST_P(Refracture, KeepsTheContractAtEveryDepth) {
    const Descent& descent = GetParam();
    if (!std::string(descent.model).starts_with("builtin:")) SKIP_WITHOUT_MESHES();
    std::mt19937 random(static_cast<uint32_t>(descent.seed));
    Model model = modelFrom(descent.model);
    for (uint32_t depth = 0; depth <= kDepth; ++depth) {
        SCOPED_TRACE("depth " + std::to_string(depth));
        FractureOptions options;
        options.site_count = 2 + static_cast<uint32_t>(random() % 19);
        options.seed = descent.seed + depth;
        const auto result = fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
        ASSERT_TRUE(result) << result.error().message;
        expectContract(model, *result);
        if (HasFailure()) return;
        model = modelFrom(result->fragments, chosen(result->fragments, descent.choice, random));
    }
}

std::vector<Descent> descents(std::initializer_list<const char*> models, uint64_t first_seed, uint64_t last_seed) {
    std::vector<Descent> all;
    for (const char* model : models)
        for (const Choice choice : {Choice::Largest, Choice::Random})
            for (uint64_t seed = first_seed; seed <= last_seed; ++seed)
                all.push_back({model, choice, seed});
    return all;
}

INSTANTIATE_TEST_SUITE_P(Small, Refracture, testing::ValuesIn(descents({"builtin:cube"}, 1, 1)), nameOf);
INSTANTIATE_TEST_SUITE_P(Quick, Refracture,
                         testing::ValuesIn(descents({"builtin:ring", "builtin:bumpy:3", "spot_low_resolution.obj",
                                                     "gearwheel.bin.stl", "cheese.off"},
                                                    1, 1)),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(Long, Refracture,
                         testing::ValuesIn(descents({"builtin:cube", "builtin:ring", "builtin:bumpy:4",
                                                     "spot_low_resolution.obj", "gearwheel.bin.stl", "cheese.off",
                                                     "fandisk.off", "utah_teapot.stl"},
                                                    2, 9)),
                         nameOf);

// Cells with corners in the corners of the mesh's box.
std::vector<brittle::Double3> latticeOver(const brittle::Mesh& mesh, int per_axis) {
    brittle::Box box;
    for (const brittle::Float3& p : mesh.positions)
        box.grow(brittle::operator+(mesh.center, brittle::toDouble(p)));
    std::vector<brittle::Double3> sites;
    for (int k = 0; k < per_axis * per_axis * per_axis; ++k) {
        const std::array<int, 3> at = {k % per_axis, k / per_axis % per_axis, k / per_axis / per_axis};
        brittle::Double3& site = sites.emplace_back();
        for (size_t axis = 0; axis < 3; ++axis)
            site[axis] = box.lower[axis] + (at[axis] + 0.5) / per_axis * (box.upper[axis] - box.lower[axis]);
    }
    return sites;
}

// Two hollows meet at an edge, which the middle cell has inside: its fragments, and theirs, touch themselves there.
TEST(QuickRefracture, OfFragmentsOfABoxWithHollowsThatTouch) {
    const auto hollow = [](double from, double to) { return support::turnedOver(boxOf({from, from, -0.5}, {to, to, 0.5})); };
    const Model box =
        modelFrom(support::operator+(support::operator+(boxOf({-1, -1, -1}, {1, 1, 1}), hollow(-0.5, 0)), hollow(0, 0.5)));
    std::vector<Model> models = {box};
    size_t touching = 0;
    for (uint32_t depth = 0; depth < 3; ++depth) {
        SCOPED_TRACE("depth " + std::to_string(depth));
        std::vector<Model> next;
        for (const Model& model : models) {
            const auto [mesh, topology, notes] = model.prepared;
            touching += topology.edges.size() < 3 * mesh.triangles.size() / 2 ? 1 : 0;
            FractureOptions options;
            options.given_sites = latticeOver(mesh, depth == 1 ? 2 : 3);
            const auto result = fracture().shatter(mesh, topology, options);
            ASSERT_TRUE(result) << result.error().message;
            expectContract(model, *result);
            if (HasFailure()) return;
            for (size_t f = 0; f < result->fragments.fragments.size() && next.size() < 30; ++f)
                next.push_back(modelFrom(result->fragments, f));
        }
        models = std::move(next);
    }
    EXPECT_GT(touching, 1u); // the box itself, and others
}

// One more fragment set: all of a mesh.
brittle::FragmentSet wholeOf(const brittle::Mesh& mesh) {
    brittle::FragmentSet set;
    set.center = mesh.center;
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const brittle::Float3& p = mesh.positions[mesh.triangles[t][k]];
            set.indices.push_back(static_cast<uint32_t>(set.vertices.size()));
            set.vertices.push_back({{p[0], p[1], p[2]}, {0, 0, 1}, {0, 0}});
        }
    Fragment& all = set.fragments.emplace_back();
    all.vertex_count = all.outer_index_count = static_cast<uint32_t>(set.vertices.size());
    return set;
}

// A block with a slot from the top, which is so wide; where that is negative the walls have passed through each other. Corners
// are numbered around the outline, first at the front, then at the back.
brittle::Mesh slotted(float width) {
    const float e = width / 2;
    const std::array<brittle::Float2, 8> outline = {
        {{-1, -1}, {1, -1}, {1, 1}, {e, 1}, {e, -0.5f}, {-e, -0.5f}, {-e, 1}, {-1, 1}}};
    brittle::Mesh mesh;
    for (const float y : {-1.0f, 1.0f})
        for (const brittle::Float2& p : outline)
            mesh.positions.push_back({p[0], y, p[1]});
    for (const brittle::Index3& t : {brittle::Index3{0, 1, 4}, {1, 2, 3}, {1, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 7}}) {
        mesh.triangles.push_back(t);
        mesh.triangles.push_back({t[0] + 8, t[2] + 8, t[1] + 8});
    }
    for (uint32_t k = 0; k < 8; ++k) {
        const uint32_t next = (k + 1) % 8;
        mesh.triangles.push_back({k, k + 8, next});
        mesh.triangles.push_back({next, k + 8, next + 8});
    }
    return mesh;
}

// Two blocks that have an edge in common.
brittle::ImportedMesh touchingBlocks() {
    return support::operator+(boxOf({-1, -1, -1}, {0, 1, 0}), boxOf({0, -1, 0}, {1, 1, 1}));
}

std::vector<brittle::Double3> lattice(int per_axis, double offset) {
    std::vector<brittle::Double3> sites;
    for (int k = 0; k < per_axis * per_axis * per_axis; ++k) {
        const auto at = [&](int i) { return -1 + (2.0 * i + 1) / per_axis + offset; };
        sites.push_back({at(k % per_axis), at(k / per_axis % per_axis), at(k / per_axis / per_axis)});
    }
    return sites;
}

void expectBreaksAgain(const Model& model, std::initializer_list<uint32_t> site_counts) {
    expectContractOf(model, site_counts);
    for (const int per_axis : {2, 3, 4}) {
        expectContractAt(model, lattice(per_axis, 0));
        expectContractAt(model, lattice(per_axis, 1e-8));
    }
}

TEST(SmallRefracture, OfBlocksThatTouchAlongAnEdge) {
    FractureOptions whole;
    whole.site_count = 1;
    const Model blocks = modelFrom(touchingBlocks());
    EXPECT_EQ(blocks.prepared.topology.edges.size(), 35u); // of 36
    const auto result = fracture().shatter(blocks.prepared.mesh, blocks.prepared.topology, whole);
    ASSERT_TRUE(result) << result.error().message;
    ASSERT_EQ(result->fragments.fragments.size(), 2u);
    for (const size_t k : {size_t{0}, size_t{1}})
        EXPECT_EQ(modelFrom(result->fragments, k).prepared.mesh.triangles.size(), 12u);
    expectBreaksAgain(blocks, {2, 3, 20, 200});
}

TEST(SmallRefracture, OfASlotThatIsOpen) { expectBreaksAgain(modelFrom(wholeOf(slotted(0x1p-20f)), 0), {2, 3, 20, 200}); }

// With many sites cells have walls in them that lie on each other and come out at none of their faces.
TEST(SmallRefracture, OfASlotWhoseWallsTouchOrPassThroughEachOtherByRounding) {
    for (const float width : {0x1p-23f, 0x1p-22f, 0.0f, -0x1p-24f, -0x1p-23f, -0x1p-22f, -0x1p-21f, -0x1p-20f, -0x1p-18f}) {
        SCOPED_TRACE(width);
        expectBreaksAgain(modelFrom(wholeOf(slotted(width)), 0), {2, 3, 20, 60, 200});
    }
}

// Own surface, faces of earlier cuts, inner faces.
std::array<double, 3> areasOf(const brittle::FragmentSet& set, const Fragment& f) {
    std::array<double, 3> areas = {0, 0, 0};
    const uint32_t own = f.outer_index_count - f.earlier_index_count;
    for (uint32_t k = 0; k < f.outer_index_count + f.inner_index_count; k += 3) {
        reference::Triangle t;
        for (uint32_t c = 0; c < 3; ++c)
            std::copy_n(set.vertices[f.first_vertex + set.indices[f.first_index + k + c]].position, 3, t[c].begin());
        areas[k < own ? 0 : k < f.outer_index_count ? 1 : 2] += reference::areaOf({&t, 1});
    }
    return areas;
}

TEST(SmallRefracture, KeepsFacesOfEarlierCutsApartFromTheModelsOwnSurface) {
    Model model = modelFrom("builtin:bumpy:2");
    std::array<double, 2> before = {0, 0};
    for (uint32_t depth = 0; depth < 4; ++depth) {
        FractureOptions options;
        options.site_count = 4;
        const auto result = fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
        ASSERT_TRUE(result) << result.error().message;
        std::array<double, 3> sum = {0, 0, 0};
        for (const Fragment& f : result->fragments.fragments)
            for (size_t side = 0; side < 3; ++side)
                sum[side] += areasOf(result->fragments, f)[side];
        if (depth > 0) {
            EXPECT_NEAR(sum[0], before[0], 1e-5 * before[0]);
        }
        EXPECT_NEAR(sum[1], before[1], 1e-5 * before[1]);
        EXPECT_GT(sum[2], 0);
        std::mt19937 random;
        const size_t largest = chosen(result->fragments, Choice::Largest, random);
        const auto [own, earlier, inner] = areasOf(result->fragments, result->fragments.fragments[largest]);
        before = {own, earlier + inner};
        model = modelFrom(result->fragments, largest);
    }
}

TEST(SmallRefracture, RefusesWhatIsNoFragment) {
    brittle::FragmentSet set = wholeOf(slotted(0.5f));
    EXPECT_TRUE(brittle::prepareFragment(set, 0));
    EXPECT_EQ(brittle::prepareFragment(set, 1).error().message, "fragment 1 is asked for, but there are 1; count from 0");
    set.fragments[0].outer_index_count -= 3;
    EXPECT_EQ(brittle::prepareFragment(set, 0).error().message,
              "fragment 0 is not closed; break fragments as shatter made them");
}

} // namespace
