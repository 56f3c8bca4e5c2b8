// count_cells, gather_cells and link_edges: cells of every size packed into one diagram, its vertices numbered, its edges tied
// to the vertices at their ends. The reference diagram says which vertices and edges there are.
#include "tests/hard/hard_sites.h"
#include "tests/kernel/device_diagram.h"
#include "tests/reference/big_int.h"

#include <algorithm>
#include <map>
#include <set>

namespace kernel_test {
namespace {

using reference::BigInt;
using reference::SiteSet;
using reference::VertexName;
using reference::VoronoiCell;
using Triple = std::array<uint32_t, 3>;

constexpr uint32_t kNone = NO_INDEX;

// What the diagram has to hold, by name.
struct Expected {
    std::set<VertexName> vertices;                // of four sites, none of them a wall
    std::map<Triple, std::set<VertexName>> edges; // of three sites: the vertices at its ends, walls among them
};

Expected expectedOf(const std::vector<VoronoiCell>& cells) {
    Expected expected;
    const uint32_t n = static_cast<uint32_t>(cells.size());
    for (const VoronoiCell& cell : cells)
        for (const VertexName& name : cell.vertices) {
            if (name[3] < n) expected.vertices.insert(name);
            for (size_t left_out = 0; left_out < 4; ++left_out) {
                Triple edge;
                for (size_t k = 0, at = 0; k < 4; ++k)
                    if (k != left_out) edge[at++] = name[k];
                if (edge[2] < n) expected.edges[edge].insert(name);
            }
        }
    return expected;
}

// Along (q1 - q0) x (q2 - q0): does the vertex whose fourth site is x lie at the end of the edge of q0, q1, q2? It does where
// x is on that side of the plane of the three; a wall of the box, where its outward normal is.
int sideOf(const SiteSet& set, const Triple& edge, uint32_t x) {
    const uint32_t n = static_cast<uint32_t>(set.sites.size());
    const auto difference = [&](uint32_t a, size_t k) { return BigInt(int64_t{set.sites[a][k]} - set.sites[edge[0]][k]); };
    BigInt side;
    for (size_t k = 0; k < 3; ++k) {
        const size_t u = (k + 1) % 3, v = (k + 2) % 3;
        const BigInt along = difference(edge[1], u) * difference(edge[2], v) - difference(edge[1], v) * difference(edge[2], u);
        if (x < n)
            side = side + along * difference(x, k);
        else if ((x - n) / 2 == k)
            side = (x - n) % 2 == 1 ? along : -along;
    }
    return side.sign();
}

uint32_t fourthOf(const VertexName& name, const Triple& edge) {
    for (const uint32_t id : name)
        if (std::find(edge.begin(), edge.end(), id) == edge.end()) return id;
    return kNone;
}

void expectPacked(const DeviceDiagram& diagram, const std::vector<VoronoiCell>& cells) {
    const uint32_t n = static_cast<uint32_t>(cells.size());
    for (uint32_t cell = 0; cell < n; ++cell) {
        const Word4 from = diagram.cell_offsets[cell], to = diagram.cell_offsets[cell + 1];
        std::vector<uint32_t> neighbors(diagram.neighbors.begin() + from[0], diagram.neighbors.begin() + to[0]), expected;
        std::sort(neighbors.begin(), neighbors.end());
        for (const uint32_t id : cells[cell].neighbors)
            if (id < n) expected.push_back(id);
        ASSERT_EQ(neighbors, expected) << "cell " << cell;
        ASSERT_EQ(to[1] - from[1], cells[cell].vertices.size()) << "cell " << cell;
        for (uint32_t t = from[1]; t < to[1]; ++t)
            ASSERT_EQ(diagram.corner_info[t][0], cell);
        for (uint32_t k = from[0]; k < to[0]; ++k)
            ASSERT_EQ(diagram.face_cells[k], cell);
    }
}

void expectVertices(const DeviceDiagram& diagram, const Expected& expected) {
    ASSERT_EQ(diagram.vertex_sites.size(), expected.vertices.size());
    for (const Word4& name : diagram.vertex_sites)
        ASSERT_TRUE(expected.vertices.contains(name)) << name[0] << " " << name[1] << " " << name[2] << " " << name[3];
    ASSERT_EQ(std::set<Word4>(diagram.vertex_sites.begin(), diagram.vertex_sites.end()).size(), expected.vertices.size());
}

void expectEdges(const SiteSet& set, const DeviceDiagram& diagram, const Expected& expected) {
    ASSERT_EQ(diagram.edge_sites.size(), expected.edges.size());
    const uint32_t n = static_cast<uint32_t>(set.sites.size());
    for (size_t e = 0; e < diagram.edge_sites.size(); ++e) {
        const Triple edge = {diagram.edge_sites[e][0], diagram.edge_sites[e][1], diagram.edge_sites[e][2]};
        ASSERT_TRUE(expected.edges.contains(edge)) << edge[0] << " " << edge[1] << " " << edge[2];
        for (const VertexName& end : expected.edges.at(edge)) {
            const uint32_t fourth = fourthOf(end, edge);
            const int side = sideOf(set, edge, fourth);
            if (side == 0) continue; // four sites in a plane: both ends lie there until the weights move them
            const uint32_t held = diagram.edge_ends[e][side > 0 ? 1 : 0];
            if (fourth >= n)
                ASSERT_EQ(held, kNone) << "edge " << e;
            else
                ASSERT_TRUE(held != kNone && diagram.vertex_sites[held] == end)
                    << "edge " << e << " of " << edge[0] << " " << edge[1] << " " << edge[2];
        }
    }
}

void expectDiagram(const hard::HardSites& hard) {
    SCOPED_TRACE(hard.name);
    const SiteSet set = hard::snapToGrid(hard).set;
    const std::vector<VoronoiCell> cells = reference::cutAllCells(set);
    const Expected expected = expectedOf(cells);
    const DeviceDiagram diagram = diagramOnDevice(set);
    expectPacked(diagram, cells);
    if (testing::Test::HasFatalFailure()) return;
    expectVertices(diagram, expected);
    if (testing::Test::HasFatalFailure()) return;
    expectEdges(set, diagram, expected);
}

TEST(SmallPacking, OfUniformSites) {
    for (const uint32_t count : {1u, 2u, 5u, 63u, 64u, 65u})
        expectDiagram(hard::uniformSites(count, count));
}

TEST(Packing, OfManyUniformSites) { expectDiagram(hard::uniformSites(1234, 9)); }

TEST(Packing, OfTies) {
    expectDiagram(hard::cubicLattice(5));
    for (const size_t set : {7u, 10u, 16u})
        expectDiagram(hard::hardSites()[set]);
}

TEST(Packing, OfCellsOfEverySize) {
    expectDiagram(hard::sphereAroundCenter(150, .3));
    expectDiagram(hard::sphereAroundCenter(300, .2));
}

} // namespace
} // namespace kernel_test
