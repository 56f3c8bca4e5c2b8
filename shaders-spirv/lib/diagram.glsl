// Look-ups in the finished Voronoi diagram: no hash tables, only short searches in the lists of the lowest site concerned.
// Wants cell_offsets (x: neighbors, y: corners), neighbors, corners (three sites in cyclic order, Voronoi vertex or
// NO_INDEX) and corner_info (cell, first Voronoi edge) declared by the kernel, as far as used.

// An edge of three cells belongs to the lowest of them; it ends at the corner that holds the pair (x, y), x < y, in this
// order, and begins at the one that holds (y, x): along (q_x - q_i) x (q_y - q_i), with no geometry asked.
bool ownsEdge(uint cell, uint x, uint y) { return x > cell && y > x && y < BOX_BASE; }

uvec3 sorted3(uvec3 v) {
    uint low = min(min(v.x, v.y), v.z), high = max(max(v.x, v.y), v.z);
    return uvec3(low, v.x ^ v.y ^ v.z ^ low ^ high, high);
}

uvec4 sorted4(uint a, uvec3 rest) {
    uvec3 s = sorted3(rest);
    if (a <= s.x) return uvec4(a, s);
    if (a <= s.y) return uvec4(s.x, a, s.yz);
    if (a <= s.z) return uvec4(s.xy, a, s.z);
    return uvec4(s, a);
}
