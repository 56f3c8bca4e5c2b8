// The islands of a cell, as a range of the list that is sorted by cell. Wants counts and island_cells declared.
uint firstIslandFrom(uint cell) {
    uint low = 0u, high = counts[COUNT_FRAGMENTS];
    for (uint turn = 0u; turn < 32u && low < high; turn++) {
        uint middle = (low + high) / 2u;
        bool below = island_cells[middle] < cell;
        low = below ? middle + 1u : low;
        high = below ? high : middle;
    }
    return low;
}
