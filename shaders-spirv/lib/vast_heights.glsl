// Corners of a vast face are ordered by height: by y, then by x, then by their number. Wants vast_nodes declared.
ivec2 placeAt(uint k) { return vast_nodes[k].xy; }

bool isLower(ivec2 a, ivec2 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }

bool isBelow(uint a, uint b) {
    ivec2 p = placeAt(a), q = placeAt(b);
    return isLower(p, q) || (p == q && a < b);
}
