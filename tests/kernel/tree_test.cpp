// The sphere tree: all sites are in it once, no deeper than asked for, and within the radius of every node above them.
#include "tests/hard/hard_sites.h"
#include "tests/kernel/device_tree.h"

#include <algorithm>
#include <cstring>

namespace kernel_test {
namespace {

struct Tree {
    std::vector<Int4> sites;
    std::vector<Word4> nodes;
    std::vector<uint32_t> leaf_start, leaf_sites;
};

Tree treeOf(const reference::SiteSet& set, uint32_t levels) {
    const BinnedSites binned = binSites(set);
    const size_t n = binned.bin_sites.size();
    const DeviceTree tree = growTree(binned.bin_sites, levels);
    return {binned.bin_sites, valuesOf<Word4>(tree.nodes, n), valuesOf<uint32_t>(tree.leaf_start, n + 1),
            valuesOf<uint32_t>(tree.leaf_sites, n)};
}

int64_t square(const Int4& a, const Int4& b) {
    int64_t sum = 0;
    for (size_t k = 0; k < 3; ++k)
        sum += int64_t{a[k] - b[k]} * int64_t{a[k] - b[k]};
    return sum;
}

struct Walk {
    std::vector<uint32_t> met;
    uint32_t deepest = 0;
};

// Returns the sites below a node, and checks its radius and that each is nearer to its own side.
std::vector<uint32_t> walk(const Tree& tree, uint32_t node, uint32_t depth, Walk& result) {
    const auto [initial, first, second, radius] = tree.nodes[node];
    std::vector<uint32_t> below = {node};
    below.insert(below.end(), tree.leaf_sites.begin() + tree.leaf_start[node],
                 tree.leaf_sites.begin() + tree.leaf_start[node + 1]);
    result.met.insert(result.met.end(), below.begin(), below.end());
    result.deepest = std::max(result.deepest, depth);
    for (const uint32_t child : {first, second}) {
        if (child == 0) continue;
        const uint32_t own = child == first ? initial : node, other = child == first ? node : initial;
        EXPECT_EQ(tree.nodes[child - 1][0], own);
        for (const uint32_t s : walk(tree, child - 1, depth + 1, result)) {
            EXPECT_LE(square(tree.sites[s], tree.sites[own]), square(tree.sites[s], tree.sites[other]));
            below.push_back(s);
        }
    }
    float furthest = 0;
    std::memcpy(&furthest, &radius, sizeof(furthest));
    for (const uint32_t s : below)
        EXPECT_LE(static_cast<double>(square(tree.sites[s], tree.sites[initial])), double(furthest));
    return below;
}

void expectTree(const hard::HardSites& hard, uint32_t levels) {
    SCOPED_TRACE(hard.name);
    const reference::SiteSet set = hard::snapToGrid(hard).set;
    const uint32_t n = static_cast<uint32_t>(set.sites.size());
    const Tree tree = treeOf(set, levels);
    Walk result;
    result.met.push_back(n / 4); // the root's initial site
    walk(tree, 3 * n / 4, 0, result);
    std::sort(result.met.begin(), result.met.end());
    EXPECT_EQ(result.met, countUp(n));
    EXPECT_LE(result.deepest, levels);
}

TEST(SmallSphereTree, HoldsAllSitesOnceWithinItsSpheres) {
    for (const uint32_t count : {2u, 3u, 4u, 63u, 64u, 65u})
        expectTree(hard::uniformSites(count, count), 9);
}

TEST(SphereTree, HoldsLargeSetsAndLattices) {
    expectTree(hard::uniformSites(5000, 1), 15);
    expectTree(hard::cubicLattice(8), 12);
    expectTree(hard::clusters(4, 200, 1e-5, 4), 12);
}

TEST(SphereTree, ListsAtTheLeavesWhatItsDepthLeaves) { expectTree(hard::uniformSites(1234, 2), 3); }

} // namespace
} // namespace kernel_test
