// The set of (mixed triangle, cell) pairs that meet. A pair is found from several sides; the table lets it in once. Who
// wins a slot is open, the set is not: everything that follows is put in order by triangle and cell.
//
// A slot is two words, each claimed on its own: first by a triangle, then by a cell. Both stay as they are once set, so no
// word is ever read that was written without an atomic, and no memory barrier is needed (inside divergent control flow
// Mesa 22.3 loses lanes at one).
// Wants counts, pairs and pair_table declared, and pair_capacity, table_mask (in slots) as push constants.
void addPair(uint m, uint cell) {
    uint slot = (m * 0x9e3779b1u) ^ (cell * 0x85ebca6bu);
    slot = (slot ^ (slot >> 15)) * 0xc2b2ae35u;
    slot ^= slot >> 13;
    bool settled = false, added = false;
    for (uint probe = 0u; probe < 512u && !settled; probe++) {
        uint at = 2u * ((slot + probe) & table_mask);
        uint triangle = atomicCompSwap(pair_table[at], 0u, m + 1u);
        if (triangle == 0u || triangle == m + 1u) {
            uint held = atomicCompSwap(pair_table[at + 1u], 0u, cell + 1u);
            added = held == 0u;
            settled = added || held == cell + 1u;
        }
    }
    if (added) {
        uint p = atomicAdd(counts[COUNT_PAIRS], 1u);
        if (p < pair_capacity) pairs[p] = uvec2(m, cell);
    }
    if (!settled) atomicOr(counts[STATUS_FAILED], FAILED_CAPACITY);
}
