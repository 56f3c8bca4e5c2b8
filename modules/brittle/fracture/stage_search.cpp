// The sphere tree: grown level by level, what is left listed at the leaves.
#include "modules/brittle/fracture/event.h"

#include <algorithm>
#include <bit>

namespace brittle {
namespace {

// A tree of random sites is about twice as deep as a balanced one; a little deeper than the latter leaves short lists.
uint32_t treeLevels(uint32_t sites) {
    return std::min<uint32_t>(MOST_TREE_LEVELS, static_cast<uint32_t>(std::bit_width(sites)) + 2);
}

void recordLevels(const Event& e) {
    const auto& b = e.b;
    const Length sites = Length::counted(COUNT_SITES);
    for (uint32_t level = 0; level < treeLevels(e.capacity.sites); level++) {
        e.record.run("spread_tree", sites, level, {e.record.counts(), b.bin_sites, b.tree, b.tree_path, b.tree_bids});
        e.record.run("grow_tree", sites, engine::NoPush{}, {e.record.counts(), b.bin_sites, b.tree, b.tree_path, b.tree_bids});
    }
}

void recordLeaves(const Event& e) {
    const auto& b = e.b;
    const Length sites = Length::counted(COUNT_SITES, e.capacity.sites);
    e.record.run("count_leaves", sites, engine::NoPush{}, {e.record.counts(), b.bin_sites, b.tree, b.tree_path, b.leaf_counts});
    e.record.scan(sites, b.leaf_counts, b.sums, b.leaf_start, {});
    e.record.run("list_leaves", sites, engine::NoPush{},
                 {e.record.counts(), b.tree_path, b.leaf_start, b.leaf_counts, b.loose_leaves});
    e.record.run("order_leaves", sites, engine::NoPush{},
                 {e.record.counts(), b.tree_path, b.leaf_start, b.loose_leaves, b.leaf_sites});
}

} // namespace

void recordSphereTree(const Event& e) {
    e.record.commands().beginLabel("sphere_tree");
    e.record.clear({e.b.tree, e.b.tree_path, e.b.tree_bids, e.b.leaf_counts});
    recordLevels(e);
    recordLeaves(e);
    e.record.commands().endLabel();
}

} // namespace brittle
