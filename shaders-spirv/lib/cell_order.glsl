// What a lane writes of its cell: planes by their sites' ids, corners by the places of their planes, so that nothing that follows
// depends on how the cell was searched and cut. The place of each is how many come before it: a look at all of them, unrolled as
// in lib/fast_cell.glsl; a sorting network takes the driver two minutes to compile.
//
// A cell that is left open keeps its order: who goes on with it wants the walls of the box where they began.
// Wants lib/fast_cell.glsl, and all of its `key` empty, as it leaves it.
const uint kMostBounding = CORNERS / 2u + 2u; // planes that a cell of so many corners has, by Euler's formula

uint place_of[PLANES]; // of each plane, among those that are written

void addPlane(inout uvec2 planes, uint p) {
    uint bit = 1u << (p & 31u);
    planes.x |= p < 32u ? bit : 0u;
    planes.y |= p < 32u ? 0u : bit;
}

// The planes that bound the cell, and how many corners there are.
uvec2 boundingPlanes(uint low, uint high, out uint live) {
    uvec2 planes = uvec2(0u);
    live = 0u;
    for (uint k = 0u; k < CORNERS && (low | high) != 0u; k++) {
        uint t = triple[takeLowest(low, high)];
        addPlane(planes, t & 255u);
        addPlane(planes, (t >> 8) & 255u);
        addPlane(planes, t >> 16);
        live++;
    }
    return planes;
}

uint placeOfPlane(uint id) {
    uint even = 0u, odd = 0u;
    [[unroll]] for (uint k = 0u; k < kMostBounding; k += 2u) {
        even += key[k] < id ? 1u : 0u;
        odd += key[k + 1u] < id ? 1u : 0u;
    }
    return even + odd;
}

uint placeOfCorner(uint mine) {
    uint even = 0u, odd = 0u;
    [[unroll]] for (uint k = 0u; k < CORNERS; k += 2u) {
        even += key[k] < mine ? 1u : 0u;
        odd += key[k + 1u] < mine ? 1u : 0u;
    }
    return even + odd;
}

// Returns how many planes are written.
uint writeInOrder(uint first, uvec2 planes) {
    uvec2 left = planes;
    uint written = 0u;
    for (uint k = 0u; k < kMostBounding && (left.x | left.y) != 0u; k++) key[written++] = plane_id[takeLowest(left.x, left.y)];
    left = planes;
    for (uint k = 0u; k < written; k++) {
        uint p = takeLowest(left.x, left.y), id = plane_id[p], place = placeOfPlane(id);
        raw[first + place] = id;
        place_of[p] = place;
    }
    return written;
}

void writeAsTheyAre(uint first, uvec2 planes, uint count) {
    for (uint k = 0u; k < count; k++) {
        bool bounds = (((k < 32u ? planes.x : planes.y) >> (k & 31u)) & 1u) != 0u;
        raw[first + k] = bounds ? plane_id[k] : NO_INDEX;
        place_of[k] = k;
    }
}

// Smallest place first, which turns the triple but does not turn it over.
uint cornerKey(uint t) {
    uint a = place_of[t & 255u], b = place_of[(t >> 8) & 255u], c = place_of[t >> 16];
    bool first = a < b && a < c, second = !first && b < c;
    uint x = first ? a : (second ? b : c), y = first ? b : (second ? c : a), z = first ? c : (second ? a : b);
    return (x << 16) | (y << 8) | z;
}

void writeCorners(uint first, uint low, uint high, uint live, uint used) {
    for (uint k = live; k < used; k++) key[k] = kNoKey;
    for (uint k = 0u; k < live; k++) key[k] = cornerKey(triple[takeLowest(low, high)]);
    for (uint k = 0u; k < live; k++) {
        uint t = key[k];
        raw[first + placeOfCorner(t)] = (t >> 16) | (t & 0xff00u) | ((t & 255u) << 16);
    }
}

// Straight through for all lanes: a cell that is not done writes no planes and no corners.
void writeCell(uint self) {
    uint low = ~free_low, high = ~free_high & ((1u << (CORNERS - 32u)) - 1u), live;
    uvec2 planes = boundingPlanes(low, high, live);
    if (bitCount(planes.x) + bitCount(planes.y) > int(kMostBounding) && status == CELL_OK) status = CELL_UNDECIDED;
    bool ok = status == CELL_OK;
    uint open = ok ? open_count : 0u, base = self * RAW_WORDS;
    bool in_order = ok && open == 0u;
    uint used = writeInOrder(base + 2u, in_order ? planes : uvec2(0u));
    writeAsTheyAre(base + 2u, planes, open != 0u ? plane_count : 0u);
    writeCorners(base + 2u + PLANES, low, high, ok ? live : 0u, used);
    for (uint k = 0u; k < MOST_OPEN && k < open; k++) raw[base + RAW_OPEN + k] = uint(bin_sites[put_off[k]].w);
    cell_raw[self] = uvec2(base, 0u);
    raw[base] = open != 0u ? CELL_OPEN | (open << 8) : status;
    if (!in_order) queueCell(self);
    raw[base + 1u] = (open != 0u ? plane_count : used) | ((ok ? live : 0u) << 16);
}
