// The polygon of a triangle in a cell, or NO_INDEX. Wants triangle_slot, triangle_polygon_offsets and polygons declared.
uint findPolygon(uint triangle, uint cell) {
    uint m = triangle_slot[triangle];
    bool mixed = triangle_slot[triangle + 1u] != m;
    uint low = mixed ? triangle_polygon_offsets[m] : 0u, high = mixed ? triangle_polygon_offsets[m + 1u] : 0u, end = high;
    for (uint step = 0u; step < 32u && low < high; step++) {
        uint middle = (low + high) / 2u;
        if (polygons[middle].y < cell) low = middle + 1u;
        else high = middle;
    }
    return low < end && polygons[min(low, max(end, 1u) - 1u)].y == cell ? low : NO_INDEX;
}
