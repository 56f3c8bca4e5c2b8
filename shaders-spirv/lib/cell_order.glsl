// What a lane writes of its cell: planes by their sites' ids, corners by the places of their planes, so that nothing that follows
// depends on how the cell was searched and cut. The place of each is how many come before it: a look at all of them, unrolled as
// in lib/fast_cell.glsl; a sorting network takes the driver two minutes to compile.
//
// A cell that is left open keeps its order: who goes on with it wants the walls of the box where they began.
// Wants lib/fast_cell.glsl. Of its arrays, `key` holds what is put in order and `rim` the planes that still bound the cell.
uint place_of[PLANES]; // of each plane, among those that are written

// Returns how many corners there are.
uint markPlanes(uint low, uint high) {
    uint live = 0u;
    for (uint k = 0u; k < CORNERS && (low | high) != 0u; k++) {
        uint t = triple[takeLowest(low, high)];
        rim[t & 255u] = 1;
        rim[(t >> 8) & 255u] = 1;
        rim[t >> 16] = 1;
        live++;
    }
    return live;
}

uint placeOf(uint mine) {
    uint even = 0u, odd = 0u;
    [[unroll]] for (uint k = 0u; k < LIST; k += 2u) {
        even += key[k] < mine ? 1u : 0u;
        odd += key[k + 1u] < mine ? 1u : 0u;
    }
    return even + odd;
}

// Returns how many planes are written.
uint writePlanes(uint first, uint planes, bool in_order) {
    uint written = 0u;
    for (uint k = 0u; k < ROLLED(PLANES); k++) key[k] = k < planes && rim[k] != 0 ? plane_id[k] : kNoKey;
    for (uint k = 0u; k < planes; k++) {
        bool bounds = rim[k] != 0;
        uint place = in_order ? placeOf(key[k]) : k;
        if (bounds || !in_order) raw[first + place] = bounds ? plane_id[k] : NO_INDEX;
        place_of[k] = place;
        written += bounds || !in_order ? 1u : 0u;
    }
    return written;
}

// Smallest place first, which turns the triple but does not turn it over.
uint cornerKey(uint t) {
    uint a = place_of[t & 255u], b = place_of[(t >> 8) & 255u], c = place_of[t >> 16];
    bool first = a < b && a < c, second = !first && b < c;
    uint x = first ? a : (second ? b : c), y = first ? b : (second ? c : a), z = first ? c : (second ? a : b);
    return (x << 16) | (y << 8) | z;
}

void writeCorners(uint first, uint low, uint high, uint live) {
    for (uint k = 0u; k < ROLLED(LIST); k++) key[k] = kNoKey;
    for (uint k = 0u; k < live; k++) key[k] = cornerKey(triple[takeLowest(low, high)]);
    for (uint k = 0u; k < live; k++) {
        uint t = key[k];
        raw[first + placeOf(t)] = (t >> 16) | (t & 0xff00u) | ((t & 255u) << 16);
    }
}

// Straight through for all lanes: a cell that is not done writes no planes and no corners.
void writeCell(uint self) {
    bool ok = status == CELL_OK;
    uint low = ok ? ~free_low : 0u, high = ok ? ~free_high & ((1u << (CORNERS - 32u)) - 1u) : 0u, open = ok ? open_count : 0u;
    uint base = self * RAW_WORDS, live = markPlanes(low, high);
    uint planes = writePlanes(base + 2u, ok ? plane_count : 0u, open == 0u);
    writeCorners(base + 2u + PLANES, low, high, live);
    for (uint k = 0u; k < MOST_OPEN && k < open; k++) raw[base + RAW_OPEN + k] = uint(bin_sites[put_off[k]].w);
    cell_raw[self] = uvec2(base, 0u);
    raw[base] = open != 0u ? CELL_OPEN | (open << 8) : status;
    raw[base + 1u] = planes | (live << 16);
}
