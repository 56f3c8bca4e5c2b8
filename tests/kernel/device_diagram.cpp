#include "tests/kernel/device_diagram.h"

namespace kernel_test {

DeviceDiagram diagramOnDevice(const reference::SiteSet& set) {
    const uint32_t n = static_cast<uint32_t>(set.sites.size());
    const RawCells raw = cutRaw(set);
    Counts counts;
    counts[COUNT_SITES] = n;
    const engine::Buffer cell_counts = blankBuffer<Word4>(n), sums = blankBuffer<Word4>(n / SCAN_BLOCK + 1);
    const engine::Buffer offsets = blankBuffer<Word4>(n + 1);
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(kernel("count_cells"), n, engine::NoPush{}, {counts.words, raw.at, raw.raw, cell_counts});
        scan(commands, counts, n, cell_counts, sums, offsets, true,
             {COUNT_NEIGHBORS, COUNT_CORNERS, COUNT_VORONOI_VERTICES, COUNT_VORONOI_EDGES});
    });
    const engine::Buffer neighbors = blankBuffer<uint32_t>(counts[COUNT_NEIGHBORS] + 1);
    const engine::Buffer corners = blankBuffer<Word4>(counts[COUNT_CORNERS] + 1),
                         info = blankBuffer<Word2>(counts[COUNT_CORNERS] + 1);
    const engine::Buffer vertices = blankBuffer<Word4>(counts[COUNT_VORONOI_VERTICES] + 1);
    const engine::Buffer edges = blankBuffer<Word4>(counts[COUNT_VORONOI_EDGES] + 1);
    const engine::Buffer face_cells = blankBuffer<uint32_t>(counts[COUNT_NEIGHBORS] + 1);
    const engine::Buffer ends = blankBuffer<Word2>(counts[COUNT_VORONOI_EDGES] + 1);
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(kernel("gather_cells"), n, engine::NoPush{},
                          {counts.words, raw.at, raw.raw, offsets, neighbors, corners, info, vertices, ends, face_cells});
        commands.dispatch(kernel("link_edges"), counts[COUNT_VORONOI_EDGES], engine::NoPush{},
                          {counts.words, offsets, corners, info, edges, ends});
    });
    EXPECT_EQ(counts[STATUS_BAD_CELLS], 0u);
    return {valuesOf<Word4>(offsets, n + 1),
            valuesOf<uint32_t>(neighbors, counts[COUNT_NEIGHBORS]),
            valuesOf<Word4>(corners, counts[COUNT_CORNERS]),
            valuesOf<Word2>(info, counts[COUNT_CORNERS]),
            valuesOf<Word4>(vertices, counts[COUNT_VORONOI_VERTICES]),
            valuesOf<Word4>(edges, counts[COUNT_VORONOI_EDGES]),
            valuesOf<uint32_t>(face_cells, counts[COUNT_NEIGHBORS]),
            valuesOf<Word2>(ends, counts[COUNT_VORONOI_EDGES])};
}

} // namespace kernel_test
