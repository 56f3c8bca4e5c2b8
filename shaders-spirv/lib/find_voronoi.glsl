// Wants cell_offsets, corners and corner_info declared.

// Edge of cells i < j < k, or NO_INDEX.
uint findVoronoiEdge(uint i, uint j, uint k) {
    uint found = NO_INDEX;
    uint last = cell_offsets[i + 1u].y;
    for (uint t = cell_offsets[i].y; t < last; t++) {
        uvec3 c = corners[t].xyz;
        bool p0 = c.x == j && c.y == k, p1 = c.y == j && c.z == k, p2 = c.z == j && c.x == k;
        if (p0 || p1 || p2) {
            uint before = (p1 || p2) && ownsEdge(i, c.x, c.y) ? 1u : 0u;
            before += p2 && ownsEdge(i, c.y, c.z) ? 1u : 0u;
            found = corner_info[t].y + before;
            break;
        }
    }
    return found;
}
