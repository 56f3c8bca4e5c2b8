// The parts that belong to a component, as a range of the list that is sorted by owner. Wants counts and part_owners declared.
uint firstPartFrom(uint owner) {
    uint low = 0u, high = counts[COUNT_PARTS];
    for (uint turn = 0u; turn < 32u && low < high; turn++) {
        uint middle = (low + high) / 2u;
        bool below = part_owners[middle] < owner;
        low = below ? middle + 1u : low;
        high = below ? high : middle;
    }
    return low;
}
