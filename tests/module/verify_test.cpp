#include "modules/brittle/fracture/site_grid.h"
#include "modules/brittle/fracture/verify.h"
#include "modules/brittle/mesh/measures.h"
#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/mesh/primitives.h"
#include "tests/support/fragment_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace brittle;

namespace {

struct Case {
    Mesh mesh = prepareMesh(makeCube())->mesh;
    support::CubeInTwo pieces = support::cubeInTwo();

    ContractReport verify() const { return verifyContract(mesh, measureMesh(mesh), pieces.set, pieces.sites); }
    Fragment& left() { return pieces.set.fragments[0]; }
};

} // namespace

TEST(Verify, SoundFragmentsHold) {
    const ContractReport report = Case().verify();
    EXPECT_EQ(report.violation(), "");
    EXPECT_TRUE(report.holds());
    EXPECT_LT(report.volume_error, 1e-12);
    EXPECT_LT(report.outside_cell, 1e-12);
}

TEST(Verify, MissingTriangle) {
    Case c;
    c.left().outer_index_count -= 3; // the inner triangles now begin with an outer one
    c.left().first_index += 3;
    const ContractReport report = c.verify();
    EXPECT_EQ(report.open_edges, 3u);
    EXPECT_FALSE(report.holds());
}

TEST(Verify, CutFacesThatDoNotMatchBitForBit) {
    Case c;
    // One corner of the left piece, wherever it is used, moves by one bit: still closed, no longer the mirror image.
    const float before = 0.125f, after = std::nextafter(before, 1.0f);
    for (uint32_t v = 0; v < c.left().vertex_count; ++v) {
        FragmentVertex& vertex = c.pieces.set.vertices[c.left().first_vertex + v];
        if (vertex.position[0] == before && vertex.position[1] > 0 && vertex.position[2] > 0) vertex.position[0] = after;
    }
    const ContractReport report = c.verify();
    EXPECT_EQ(report.open_edges, 0u);
    EXPECT_GE(report.unpaired_inner_triangles, 2u);
}

TEST(Verify, OuterFaceDeclaredInner) {
    Case c;
    c.left().outer_index_count -= 3;
    c.left().inner_index_count += 3;
    const ContractReport report = c.verify();
    EXPECT_EQ(report.unpaired_inner_triangles, 1u);
    EXPECT_GT(report.area_error, 0.01);
}

TEST(Verify, TurnedTriangle) {
    Case c;
    uint32_t* index = &c.pieces.set.indices[c.left().first_index];
    std::swap(index[0], index[1]);
    EXPECT_EQ(c.verify().open_edges, 3u);
}

TEST(Verify, InsideOutFragment) {
    Case c;
    for (uint32_t k = 0; k < 36; k += 3)
        std::swap(c.pieces.set.indices[c.left().first_index + k], c.pieces.set.indices[c.left().first_index + k + 1]);
    const ContractReport report = c.verify();
    EXPECT_EQ(report.open_edges, 0u);
    EXPECT_EQ(report.hollow_fragments, 1u);
    EXPECT_EQ(report.parted_fragments, 1u);
    EXPECT_EQ(report.unpaired_inner_triangles, 4u);
}

TEST(Verify, TwoSolidsInOneFragment) {
    Case c;
    Fragment& left = c.left();
    const Fragment right = c.pieces.set.fragments[1];
    // The right piece, a little apart from the left one, is said to be part of it.
    std::vector<uint32_t> indices;
    for (const Fragment& f : {left, right})
        for (uint32_t k = 0; k < 36; ++k)
            indices.push_back(f.first_vertex + c.pieces.set.indices[f.first_index + k]);
    for (uint32_t v = 0; v < right.vertex_count; ++v)
        c.pieces.set.vertices[right.first_vertex + v].position[0] += 1;
    c.pieces.set.indices = indices;
    left.first_vertex = 0;
    left.vertex_count = static_cast<uint32_t>(c.pieces.set.vertices.size());
    left.first_index = 0;
    left.outer_index_count = 72;
    left.inner_index_count = 0;
    c.pieces.set.fragments.resize(1);
    const ContractReport report = c.verify();
    EXPECT_EQ(report.open_edges, 0u);
    EXPECT_EQ(report.parted_fragments, 1u);
}

// Walls of a cavity that has collapsed, and whose walls have passed through each other by so much.
TEST(Verify, CollapsedCavitiesAreNoSolids) {
    for (const float thickness : {0.0f, 1e-7f, 3e-7f, 1e-5f, 0.1f}) {
        Case c;
        brittle::FragmentSet& set = c.pieces.set;
        Fragment& left = c.left();
        const uint32_t first_vertex = static_cast<uint32_t>(set.vertices.size()),
                       first = static_cast<uint32_t>(set.indices.size());
        // The piece itself, and a flat one like it in its middle.
        for (uint32_t v = 0; v < left.vertex_count; ++v)
            set.vertices.push_back(set.vertices[left.first_vertex + v]);
        for (uint32_t v = 0; v < left.vertex_count; ++v) {
            brittle::FragmentVertex& flat = set.vertices.emplace_back(set.vertices[left.first_vertex + v]);
            flat.position[0] = -0.25f + flat.position[0] / 4;
            flat.position[1] /= 4;
            flat.position[2] *= thickness;
        }
        for (uint32_t k = 0; k < 72; ++k)
            set.indices.push_back(set.indices[left.first_index + k % 36] + (k < 36 ? 0 : left.vertex_count));
        left.first_vertex = first_vertex;
        left.first_index = first;
        left.vertex_count *= 2;
        left.outer_index_count = 72;
        left.inner_index_count = 0;
        EXPECT_EQ(c.verify().parted_fragments, thickness > 1e-6f ? 1u : 0u) << thickness;
    }
}

TEST(Verify, FragmentOfTheWrongCell) {
    Case c;
    std::swap(c.pieces.sites[0], c.pieces.sites[1]);
    EXPECT_GT(c.verify().outside_cell, 0.1);
    Case d;
    d.pieces.sites[1][0] -= 0.01; // the bisector moves by half of that
    EXPECT_NEAR(d.verify().outside_cell, 0.005 / std::sqrt(3.0), 1e-6);
}

TEST(Verify, MissingFragmentAndWrongFrame) {
    Case c;
    c.pieces.set.fragments.pop_back();
    EXPECT_GT(c.verify().volume_error, 0.3);
    EXPECT_GT(c.verify().unpaired_inner_triangles, 0u);
    Case d;
    d.pieces.set.center[1] += 1;
    EXPECT_FALSE(d.verify().holds());
}

TEST(Verify, WhatIsNoNumberDoesNotHold) {
    Case c;
    c.pieces.set.vertices[3].position[1] = std::nanf("");
    EXPECT_FALSE(c.verify().holds());
}

TEST(SiteGrid, FindsWhatASearchOfAllFinds) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const size_t count : {size_t{0}, size_t{1}, size_t{2}, size_t{1000}})
        for (const double flatness : {1.0, 0.0}) {
            std::vector<Double3> sites(count);
            for (Double3& site : sites)
                site = {unit(random), unit(random), flatness * unit(random)};
            const SiteGrid grid(sites);
            for (const double radius : {0.0, 0.05, 0.4, 3.0}) {
                const Double3 center = {unit(random) * 1.4 - 0.2, unit(random), unit(random)};
                std::vector<uint32_t> found, expected;
                grid.findNear(center, radius, found);
                for (uint32_t s = 0; s < count; ++s)
                    if (length(sites[s] - center) < radius) expected.push_back(s);
                std::sort(found.begin(), found.end());
                EXPECT_EQ(found, expected);
            }
        }
}
