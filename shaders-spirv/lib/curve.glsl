// The place of a cell of a cube on Hilbert's curve through it (Skilling, Programming the Hilbert curve, 2004): what lies next to
// each other on it does so in space. Over Morton's order a tree of equal blocks has up to two thirds more of its nodes visited.
uint everyThird(uint bits) { // ten bits
    bits = (bits | (bits << 16)) & 0x030000ffu;
    bits = (bits | (bits << 8)) & 0x0300f00fu;
    bits = (bits | (bits << 4)) & 0x030c30c3u;
    return (bits | (bits << 2)) & 0x09249249u;
}

uint interleaved(uvec3 bits) { return (everyThird(bits.x) << 2) | (everyThird(bits.y) << 1) | everyThird(bits.z); }

// From the coarsest cube inwards: what lies below a bit is turned over, or changes places with the first axis, so that the curve
// through each half begins where it left the last.
uvec3 turned(uvec3 cell) {
    for (uint bit = ROLLED(CURVE_BITS - 1u); bit > 0u; bit--) {
        uint below = (1u << bit) - 1u;
        for (uint axis = 0u; axis < 3u; axis++) {
            bool upper = ((cell[axis] >> bit) & 1u) != 0u;
            uint swap = upper ? 0u : (cell.x ^ cell[axis]) & below;
            cell.x ^= upper ? below : swap;
            cell[axis] ^= swap;
        }
    }
    return cell;
}

// Low and high word of KEY_LOW_BITS each, of coordinates of CURVE_BITS.
uvec2 placeOnCurve(uvec3 cell) {
    uvec3 place = turned(cell);
    place.y ^= place.x;
    place.z ^= place.y;
    uint odd = place.z >> 1;
    for (uint step = 1u; step < 32u; step <<= 1) odd ^= odd >> step;
    place ^= uvec3(odd);
    return uvec2(interleaved(place & 0x3ffu), interleaved(place >> 10));
}
