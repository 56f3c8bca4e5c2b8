// cut_cells, cut_cells_edges and cut_cells_exact against the reference diagram: the same neighbors and the same vertices, cell
// by cell.
#include "tests/hard/hard_sites.h"
#include "tests/kernel/device_cells.h"

namespace kernel_test {
namespace {

// Names the first few cells that differ, and in what.
void expectSameDiagram(const std::vector<reference::VoronoiCell>& expected, const DeviceCells& device) {
    EXPECT_EQ(device.unfinished, 0u);
    ASSERT_EQ(device.cells.size(), expected.size());
    uint32_t different = 0;
    for (size_t k = 0; k < expected.size(); ++k) {
        const bool same =
            device.cells[k].neighbors == expected[k].neighbors && device.cells[k].vertices == expected[k].vertices;
        if (same) continue;
        if (++different <= 3)
            ADD_FAILURE() << "cell " << k << " has " << device.cells[k].neighbors.size() << " faces and "
                          << device.cells[k].vertices.size() << " vertices; " << expected[k].neighbors.size() << " and "
                          << expected[k].vertices.size() << " are right";
    }
    EXPECT_EQ(different, 0u) << "cells of " << expected.size() << " are not right";
    const reference::DiagramAudit audit = reference::auditDiagram(device.cells);
    EXPECT_EQ(audit.lost_cells, 0u);
    EXPECT_EQ(audit.one_sided_faces, 0u);
    EXPECT_EQ(audit.disputed_vertices, 0u);
    EXPECT_EQ(audit.broken_cells, 0u);
}

void expectSameDiagram(const reference::SiteSet& set, const DeviceCells& device) {
    expectSameDiagram(reference::cutAllCells(set), device);
}

class CutCellsHard : public testing::TestWithParam<size_t> {};

TEST_P(CutCellsHard, GivesTheReferenceDiagram) {
    const hard::HardSites hard = hard::hardSites()[GetParam()];
    SCOPED_TRACE(hard.name);
    const reference::SiteSet set = hard::snapToGrid(hard).set;
    const std::vector<reference::VoronoiCell> expected = reference::cutAllCells(set);
    expectSameDiagram(expected, cutOnDevice(set));
    SCOPED_TRACE("a lane an edge");
    expectSameDiagram(expected, cutOnDevice(set, Path::FilteredEdges));
}

INSTANTIATE_TEST_SUITE_P(Small, CutCellsHard, testing::Values(7, 16, 24, 25));
INSTANTIATE_TEST_SUITE_P(Quick, CutCellsHard,
                         testing::Values(0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13, 14, 15, 17, 18, 19, 20, 21, 22, 23, 26));

TEST(CutCells, OfUniformSitesOfManyCounts) {
    for (const uint32_t count : {1u, 2u, 63u, 64u, 65u, 1234u}) {
        SCOPED_TRACE(count);
        const reference::SiteSet set = hard::snapToGrid(hard::uniformSites(count, count)).set;
        expectSameDiagram(set, cutOnDevice(set));
        if (count < 100) expectSameDiagram(set, cutOnDevice(set, Path::Exact));
    }
}

class CutCellsBySearch : public testing::TestWithParam<Path> {};

TEST_P(CutCellsBySearch, FindsTheSameCells) {
    for (const uint32_t count : {1u, 2u, 64u, 65u, 1234u}) {
        SCOPED_TRACE(count);
        const reference::SiteSet set = hard::snapToGrid(hard::uniformSites(count, count)).set;
        expectSameDiagram(set, cutOnDevice(set, GetParam()));
    }
    for (const hard::HardSites& sites :
         {hard::clusters(8, 40, 1e-3, 3), hard::cubicLattice(6), hard::sphereAroundCenter(70, .3)}) {
        SCOPED_TRACE(sites.name);
        const reference::SiteSet set = hard::snapToGrid(sites).set;
        expectSameDiagram(set, cutOnDevice(set, GetParam()));
    }
}

INSTANTIATE_TEST_SUITE_P(Quick, CutCellsBySearch,
                         testing::Values(Path::FilteredLinear, Path::FilteredTree, Path::FilteredEdges));

TEST(CutCellsSearch, FindsTheSameCellsAcrossWorkgroups) {
    const reference::SiteSet set = hard::snapToGrid(hard::uniformSites(300, 5)).set;
    expectSameDiagram(set, cutOnDevice(set, Path::FilteredLinear));
    expectSameDiagram(set, cutOnDevice(set, Path::FilteredTree));
}

TEST(CutCells, OfUniformSitesAreMostlyDecidedByTheFilter) {
    const reference::SiteSet set = hard::snapToGrid(hard::uniformSites(10'000, 1)).set;
    const DeviceCells device = cutOnDevice(set);
    expectSameDiagram(set, device);
    EXPECT_LT(device.undecided, 500u);
    EXPECT_LT(cutOnDevice(set, Path::FilteredEdges).undecided, 500u);
}

TEST(CutCells, OfCrowdsAndLattices) {
    for (const hard::HardSites& sites :
         {hard::clusters(8, 40, 1e-3, 3), hard::clusters(3, 100, 1e-5, 4), hard::cubicLattice(6)}) {
        SCOPED_TRACE(sites.name);
        const reference::SiteSet set = hard::snapToGrid(sites).set;
        expectSameDiagram(set, cutOnDevice(set));
    }
}

TEST(CutCells, OfCrowdsAboutABlow) {
    for (const uint32_t count : {500u, 3000u}) {
        SCOPED_TRACE(count);
        const reference::SiteSet set = hard::snapToGrid(hard::sitesAboutBlow(count, .03, count)).set;
        expectSameDiagram(set, cutOnDevice(set, Path::FilteredTree));
    }
}

TEST(CutCells, WithManyFacesAreDoneAgainWithMoreRoom) {
    const reference::SiteSet set = hard::snapToGrid(hard::sphereAroundCenter(150, .3)).set;
    const DeviceCells device = cutOnDevice(set);
    expectSameDiagram(set, device);
    expectSameDiagram(set, cutOnDevice(set, Path::FilteredEdges));
    EXPECT_EQ(device.redone, 1u);
    EXPECT_EQ(device.cells[0].neighbors.size(), 150u);
}

TEST(CutCells, WithThreeHundredFaces) {
    const reference::SiteSet set = hard::snapToGrid(hard::sphereAroundCenter(300, .01)).set;
    expectSameDiagram(set, cutOnDevice(set));
}

TEST(CutCells, WithTwoThousandFaces) {
    const reference::SiteSet set = hard::snapToGrid(hard::sphereAroundCenter(2000, .3)).set;
    expectSameDiagram(set, cutOnDevice(set));
}

TEST(LongCutCells, OfThreeThousandSitesOnASphere) {
    hard::HardSites sites = hard::sphereAroundCenter(3000, .3);
    sites.sites.erase(sites.sites.begin());
    const reference::SiteSet set = hard::snapToGrid(sites).set;
    expectSameDiagram(set, cutOnDevice(set));
}

} // namespace
} // namespace kernel_test
