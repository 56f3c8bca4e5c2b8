#include "tests/kernel/device_tree.h"

namespace kernel_test {

DeviceTree growTree(const std::vector<Int4>& bin_sites, uint32_t levels) {
    const uint32_t n = static_cast<uint32_t>(bin_sites.size());
    Counts counts;
    counts[COUNT_SITES] = n;
    const engine::Buffer sites = bufferOf(bin_sites);
    const engine::Buffer path = bufferOf(std::vector<uint32_t>(n)), bids = bufferOf(std::vector<uint32_t>(2 * n));
    const engine::Buffer leaf_counts = bufferOf(std::vector<uint32_t>(n)), sums = blankBuffer<Word4>(n / SCAN_BLOCK + 1);
    const engine::Buffer loose = blankBuffer<uint32_t>(n);
    DeviceTree tree{bufferOf(std::vector<Word4>(n)), blankBuffer<uint32_t>(n + 1), blankBuffer<uint32_t>(n)};
    onDevice([&](engine::Commands& commands) {
        for (uint32_t level = 0; level < levels; ++level) {
            commands.dispatch(kernel("spread_tree"), n, level, {counts.words, sites, tree.nodes, path, bids});
            commands.dispatch(kernel("grow_tree"), n, engine::NoPush{}, {counts.words, sites, tree.nodes, path, bids});
        }
        commands.dispatch(kernel("count_leaves"), n, engine::NoPush{}, {counts.words, sites, tree.nodes, path, leaf_counts});
        scan(commands, counts, n, leaf_counts, sums, tree.leaf_start, false, {NO_INDEX, NO_INDEX, NO_INDEX, NO_INDEX});
        commands.dispatch(kernel("list_leaves"), n, engine::NoPush{},
                          {counts.words, path, tree.leaf_start, leaf_counts, loose});
        commands.dispatch(kernel("order_leaves"), n, engine::NoPush{},
                          {counts.words, path, tree.leaf_start, loose, tree.leaf_sites});
    });
    return tree;
}

} // namespace kernel_test
