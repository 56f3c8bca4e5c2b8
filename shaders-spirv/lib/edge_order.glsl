// What a workgroup writes of its cell: planes by their sites' ids, corners by the places of their planes, so that nothing that
// follows depends on how the cell was searched and cut (as lib/cell_order.glsl). Wants lib/edge_cell.glsl.
shared uint bounds_cell[PLANES];

void markPlanes(uint lane) {
    for (uint p = lane; p < PLANES; p += LANES) bounds_cell[p] = 0u;
    sync();
    for (uint t = lane; t < corner_top; t += LANES) {
        uint triple = triple_copies[copy][t];
        bounds_cell[triple & 0xffu] = 1u;
        bounds_cell[(triple >> 8) & 0xffu] = 1u;
        bounds_cell[triple >> 16] = 1u;
    }
    sync();
}

// The place of each plane, in `entry`; returns how many bound the cell.
uint placePlanes(uint lane, bool in_order) {
    uint bounding = 0u;
    for (uint q = 0u; q < plane_count; q++) bounding += bounds_cell[q];
    for (uint p = lane; p < plane_count; p += LANES) {
        uint place = in_order ? 0u : p;
        for (uint q = 0u; q < plane_count && in_order; q++) place += bounds_cell[q] != 0u && plane_id[q] < plane_id[p] ? 1u : 0u;
        entry[p] = place;
    }
    sync();
    return bounding;
}

// Smallest place first, which turns the triple but does not turn it over.
uint cornerKey(uint triple) {
    uint a = entry[triple & 0xffu], b = entry[(triple >> 8) & 0xffu], c = entry[triple >> 16];
    bool first = a < b && a < c, second = !first && b < c;
    uint x = first ? a : (second ? b : c), y = first ? b : (second ? c : a), z = first ? c : (second ? a : b);
    return (x << 16) | (y << 8) | z;
}

// Keys of the corners, where the edges were, and their places, in corner_goes.
void placeCorners(uint lane) {
    for (uint t = lane; t < corner_top; t += LANES) edge_copies[copy][t] = cornerKey(triple_copies[copy][t]);
    sync();
    for (uint t = lane; t < corner_top; t += LANES) {
        uint place = 0u;
        for (uint u = 0u; u < corner_top; u++) place += edge_copies[copy][u] < edge_copies[copy][t] ? 1u : 0u;
        corner_goes[t] = place;
    }
    sync();
}
