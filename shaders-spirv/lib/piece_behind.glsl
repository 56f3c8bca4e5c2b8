// What lies behind one side of a cap: the other side, next to it; behind one that was dropped with its flap, what the flap's
// other side faced. `caps` is the first side of all. Wants sources and parents declared.
uint pieceBehind(uint side, uint caps) {
    uint behind = caps + ((side - caps) ^ 1u);
    for (uint flaps = 0u; flaps < 64u && (sources[behind] & FLAP_BIT) != 0u; flaps++) behind = caps + ((parents[behind] - caps) ^ 1u);
    return behind;
}
