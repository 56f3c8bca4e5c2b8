// The oracle's own test: known diagrams, independence from the order of cuts, and an audit that sees planted faults.
#include "tests/reference/voronoi.h"

#include "tests/hard/hard_sites.h"
#include "tests/reference/geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace reference {
namespace {

double boxVolume(const GridBox& box) {
    double volume = 1;
    for (size_t k = 0; k < 3; ++k)
        volume *= box.upper[k] - box.lower[k];
    return volume;
}

double totalVolume(const std::vector<VoronoiCell>& cells) {
    double volume = 0;
    for (const VoronoiCell& cell : cells)
        volume += cellVolume(cell);
    return volume;
}

TEST(ReferenceVoronoi, OneSiteOwnsTheBox) {
    const SiteSet set{{{0, 0, 0}, {10, 20, 30}}, {{3, 4, 5}}};
    const VoronoiCell cell = cutCell(set, 0);
    EXPECT_EQ(cell.neighbors, (std::vector<uint32_t>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(cell.vertices.size(), 8u);
    EXPECT_EQ(cell.vertices.front(), (VertexName{0, 1, 3, 5}));
    EXPECT_NEAR(cellVolume(cell), 6000, 1e-9);
    for (const CellFace& face : cell.faces)
        EXPECT_EQ(face.sides.size(), 4u);
}

TEST(ReferenceVoronoi, TwoSitesShareOneFace) {
    const SiteSet set{{{0, 0, 0}, {10, 10, 10}}, {{2, 5, 5}, {6, 5, 5}}};
    const VoronoiCell left = cutCell(set, 0), right = cutCell(set, 1);
    EXPECT_EQ(left.neighbors, (std::vector<uint32_t>{1, 2, 4, 5, 6, 7}));  // all but +x
    EXPECT_EQ(right.neighbors, (std::vector<uint32_t>{0, 3, 4, 5, 6, 7})); // all but -x
    EXPECT_NEAR(cellVolume(left), 400, 1e-9);
    EXPECT_NEAR(cellVolume(right), 600, 1e-9);
}

// In the middle of a cubic lattice every vertex is a tie of eight cells. With the weights broken the diagram has to be simple
// all the same, and the six true faces of a cube have to be there.
TEST(ReferenceVoronoi, LatticeTiesAreBrokenAlikeByAllCells) {
    const SiteSet set = hard::snapToGrid(hard::cubicLattice(4)).set;
    const std::vector<VoronoiCell> cells = cutAllCells(set);
    EXPECT_TRUE(auditDiagram(cells).sound());
    const uint32_t middle = 1 * 16 + 1 * 4 + 1;
    for (const uint32_t side : {middle - 16, middle + 16, middle - 4, middle + 4, middle - 1, middle + 1})
        EXPECT_TRUE(std::binary_search(cells[middle].neighbors.begin(), cells[middle].neighbors.end(), side));
    EXPECT_NEAR(cellVolume(cells[middle]) / boxVolume(set.box) * 64, 1, 1e-6);
}

// Four cocircular sites in a thin box: the lowest id is the heaviest, so its diagonal is the one that touches.
TEST(ReferenceVoronoi, LowestIdWinsTheDiagonal) {
    const SiteSet set{{{0, 0, 0}, {4, 4, 4}}, {{1, 1, 2}, {3, 1, 2}, {3, 3, 2}, {1, 3, 2}}};
    const auto touches = [&](uint32_t a, uint32_t b) {
        const auto neighbors = cutCell(set, a).neighbors;
        return std::binary_search(neighbors.begin(), neighbors.end(), b);
    };
    EXPECT_TRUE(touches(0, 2));
    EXPECT_FALSE(touches(1, 3));
}

TEST(ReferenceVoronoi, SpiralSphereGivesItsCenterAllFaces) {
    const SiteSet set = hard::snapToGrid(hard::sphereAroundCenter(300, .01)).set;
    const VoronoiCell cell = cutCell(set, 0);
    EXPECT_EQ(cell.neighbors.size(), 300u);
    EXPECT_EQ(cell.vertices.size(), 596u);
}

class HardSet : public testing::TestWithParam<size_t> {};

TEST_P(HardSet, IsOneSoundDiagramThatFillsTheBox) {
    const hard::HardSites hard = hard::hardSites()[GetParam()];
    SCOPED_TRACE(hard.name);
    const SiteSet set = hard::snapToGrid(hard).set;
    const std::vector<VoronoiCell> cells = cutAllCells(set);
    const DiagramAudit audit = auditDiagram(cells);
    EXPECT_EQ(audit.lost_cells, 0u);
    EXPECT_EQ(audit.one_sided_faces, 0u);
    EXPECT_EQ(audit.disputed_vertices, 0u);
    EXPECT_EQ(audit.broken_cells, 0u);
    EXPECT_NEAR(totalVolume(cells) / boxVolume(set.box), 1, 1e-12);
}

TEST_P(HardSet, DoesNotDependOnTheOrderOfCuts) {
    const SiteSet set = hard::snapToGrid(hard::hardSites()[GetParam()]).set;
    const uint32_t n = static_cast<uint32_t>(set.sites.size());
    for (uint32_t site = 0; site < n; site += 1 + n / 20) {
        const VoronoiCell near_first = cutCell(set, site), by_id = cutCell(set, site, Cutting::Everything);
        EXPECT_EQ(near_first.neighbors, by_id.neighbors);
        EXPECT_EQ(near_first.vertices, by_id.vertices);
    }
}

INSTANTIATE_TEST_SUITE_P(All, HardSet, testing::Range(size_t{0}, size_t{27}));

// The cells against the definition: a point is within the cell of its nearest site and no other.
TEST(ReferenceVoronoi, PointsLieInTheCellOfTheirNearestSite) {
    const SiteSet set = hard::snapToGrid(hard::uniformSites(60, 5)).set;
    const std::vector<VoronoiCell> cells = cutAllCells(set);
    std::mt19937 random(1);
    std::uniform_int_distribution<int32_t> coordinate(0, set.box.upper[0]);
    for (int k = 0; k < 200; ++k) {
        const GridPoint p = {coordinate(random), coordinate(random), coordinate(random)};
        for (const VoronoiCell& cell : cells) {
            Triangles surface;
            for (const CellFace& face : cell.faces)
                for (size_t c = 1; c + 1 < face.corners.size(); ++c)
                    surface.push_back({face.corners[0], face.corners[c], face.corners[c + 1]});
            Point relative;
            for (size_t c = 0; c < 3; ++c)
                relative[c] = p[c] - set.sites[cell.site][c];
            EXPECT_NEAR(double(windingNumber(surface, relative)), nearestSite(set.sites, p) == cell.site ? 1 : 0, 1e-2);
        }
    }
}

TEST(ReferenceVoronoi, AuditSeesPlantedFaults) {
    const std::vector<VoronoiCell> sound = cutAllCells(hard::snapToGrid(hard::uniformSites(50, 1)).set);
    ASSERT_TRUE(auditDiagram(sound).sound());

    std::vector<VoronoiCell> cells = sound;
    cells[7].neighbors.erase(cells[7].neighbors.begin());
    EXPECT_EQ(auditDiagram(cells).one_sided_faces, 1u);
    EXPECT_EQ(auditDiagram(cells).broken_cells, 1u);

    cells = sound;
    cells[7].vertices[3][3] += 1;
    EXPECT_GT(auditDiagram(cells).disputed_vertices, 0u);

    cells = sound;
    cells[7].neighbors.clear();
    cells[7].vertices.clear();
    EXPECT_EQ(auditDiagram(cells).lost_cells, 1u);
}

} // namespace
} // namespace reference
