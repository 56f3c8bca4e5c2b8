// Sides of vast faces, each known by the corner where it begins. Wants vast_ends and vast_chords.
//
// vast_ends: names of both corners, whether the side is left after opposite ones have canceled, and its face.
// vast_chords: places of both corners.
ivec2 placeOf(uint side) { return vast_chords[side].xy; }

// Corners are ordered by height: by y, then by x, then by number.
bool isLower(ivec2 a, ivec2 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }

bool isBelow(uint a, uint b) {
    ivec2 p = placeOf(a), q = placeOf(b);
    return isLower(p, q) || (p == q && a < b);
}
