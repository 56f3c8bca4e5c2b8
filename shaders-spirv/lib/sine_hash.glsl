// The paper's random numbers (listing 1), fract(sin(12.9898 x + 78.233 y) * 43758.5453), in fixed point: devices' own sines
// differ, and the factor blows up their last digits. Returned of 2^32.

// sin(2 pi t), t of 2^32, result of 2^30: within a quarter turn the odd polynomial of Taylor's series to the ninth power.
int sineOf(uint t) {
    uint quarter = t << 2, turn = t >> 30;
    uint64_t x = (turn & 1u) != 0u ? (uint64_t(1) << 32) - uint64_t(quarter) : uint64_t(quarter); // of 2^32: of a quarter turn
    uint64_t square = (x * (x >> 1)) >> 31;
    uint64_t s = uint64_t(172272u);                  // (pi/2)^9 / 9!, of 2^30
    s = 5026995ul - ((s * square) >> 32);            // (pi/2)^7 / 7!
    s = 85569306ul - ((s * square) >> 32);           // (pi/2)^5 / 5!
    s = 693598668ul - ((s * square) >> 32);          // (pi/2)^3 / 3!
    s = 1686629713ul - ((s * square) >> 32);         // pi/2
    int sine = int((s * x) >> 32);
    return (turn & 2u) != 0u ? -sine : sine;
}

uint sineHash(uint x, uint y) {
    uint turns = x * 289441625u + y * 1937754652u; // 12.9898 and 78.233 over 2 pi, of 2^32; whole turns fall away
    uint64_t product = uint64_t(int64_t(sineOf(turns))) * 2867760025ul; // 43758.5453 of 2^16
    return uint(product >> 14);
}
