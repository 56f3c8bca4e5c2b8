// The tables of free ranges. Wants headers declared, and range_room: entries of a half.
struct PoolTable {
    uint from, to; // the list's half, and the other
    uint count;    // free ranges
};

PoolTable tableOf(uint pool) {
    uint side = headers[pool].side;
    return PoolTable((2u * pool + side) * range_room, (2u * pool + 1u - side) * range_room, headers[pool].free_ranges);
}
