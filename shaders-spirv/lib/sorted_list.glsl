// Where the entries of one key begin in a list that is sorted by key. Wants SORTED defined as the list, or SORTED_KEY(i) where its
// entries hold more than the key, SORTED_COUNT as the count of its entries, and counts declared.
#ifndef SORTED_KEY
#define SORTED_KEY(i) SORTED[i]
#endif
uint firstFrom(uint key) {
    uint low = 0u, high = counts[SORTED_COUNT];
    for (uint turn = 0u; turn < 32u && low < high; turn++) {
        uint middle = (low + high) / 2u;
        bool below = SORTED_KEY(middle) < key;
        low = below ? middle + 1u : low;
        high = below ? high : middle;
    }
    return low;
}
