// Place of a site in a list that lanes filled in any order, as if it were sorted: nothing later depends on which came first. Too
// long a list stops the event. Wants LOOSE defined as the list, and counts declared.
uint rankIn(uint first, uint last, uint site) {
    if (last - first > MOST_IN_A_BIN) {
        atomicMax(counts[STATUS_CROWDED], last - first);
        atomicOr(counts[STATUS_FAILED], FAILED_CELLS);
    }
    uint rank = 0u, end = min(last, first + MOST_IN_A_BIN);
    for (uint k = first; k < end; k++) rank += LOOSE[k] < site ? 1u : 0u;
    return rank;
}
