// The largest integer whose square is not above x, a bit at a time.
uint rootOf64(uint64_t x) {
    uint root = 0u;
    for (uint k = 0u; k < 32u; k++) {
        uint next = root | (0x80000000u >> k);
        uint64_t square = uint64_t(next) * uint64_t(next);
        root = square <= x ? next : root;
    }
    return root;
}
