#include "tests/kernel/component_pools.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace kernel_test {
namespace {

struct Pools {
    std::vector<uint32_t> start = {0}, order, sources;
    std::vector<Word4> pieces;
    std::vector<std::array<float, 4>> positions;
};

Pools poolsOf(const std::vector<Component>& components) {
    Pools pools;
    size_t total = 0;
    for (const Component& component : components)
        total += component.triangles.size();
    pools.order.resize(total);
    std::iota(pools.order.begin(), pools.order.end(), 0u);
    std::shuffle(pools.order.begin(), pools.order.end(), std::mt19937(7));
    pools.pieces.resize(total);
    pools.sources.resize(total);
    uint32_t at = 0;
    for (const Component& component : components) {
        for (size_t t = 0; t < component.triangles.size(); ++t, ++at) {
            const uint32_t first = static_cast<uint32_t>(pools.positions.size());
            pools.pieces[pools.order[at]] = {first, first + 1, first + 2, component.cell};
            pools.sources[pools.order[at]] = t < component.outer ? 5 : INNER_BIT | 5;
            for (const reference::Point& p : component.triangles[t])
                pools.positions.push_back({float(p[0]), float(p[1]), float(p[2]), 0});
        }
        pools.start.push_back(at);
    }
    return pools;
}

} // namespace

Judged judgeOnDevice(const std::vector<Component>& components, float grid_step) {
    const Pools pools = poolsOf(components);
    const uint32_t n = static_cast<uint32_t>(components.size());
    Counts counts;
    counts[COUNT_COMPONENTS] = n;
    const engine::Buffer start = bufferOf(pools.start), order = bufferOf(pools.order), pieces = bufferOf(pools.pieces);
    const engine::Buffer sources = bufferOf(pools.sources), positions = bufferOf(pools.positions);
    const engine::Buffer records = blankBuffer<brittle::FragmentRecord>(n), fates = blankBuffer<Word2>(n);
    const engine::Buffer cavities = blankBuffer<uint32_t>(n), films = blankBuffer<uint32_t>(n);
    onDevice([&](engine::Commands& commands) {
        commands.dispatchGroups(kernel("mass_properties"), n, 1.0f,
                                {counts.words, start, order, pieces, sources, positions, records});
        commands.dispatch(kernel("decide_fates"), n, grid_step, {counts.words, records, fates, cavities, films});
        counts.publish(commands, COUNT_CAVITIES, n);
        counts.publish(commands, COUNT_FILMS, n);
        const std::array<float, 3> nest = {1, grid_step, 0};
        commands.dispatchIndirect(kernel("nest_films"), counts.groupsOf(COUNT_FILMS), nest,
                                  {counts.words, films, start, order, pieces, positions, records, fates});
        commands.dispatchIndirect(kernel("nest_cavities"), counts.groupsOf(COUNT_CAVITIES), nest,
                                  {counts.words, cavities, start, order, pieces, positions, records, fates});
    });
    return {valuesOf<brittle::FragmentRecord>(records, n), valuesOf<Word2>(fates, n), counts[COUNT_FILMS],
            counts[COUNT_CAVITIES], counts[STATUS_BAD_UNION]};
}

} // namespace kernel_test
