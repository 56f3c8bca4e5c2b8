// Where a corner of what breaks comes from. Wants `breaking` and `counts` declared.

// The object that a corner belongs to: the last that begins at or before it.
uint objectOf(uint corner) {
    uint low = 0u, high = max(counts[COUNT_BREAKING], 1u) - 1u;
    for (uint step = 0u; step < 9u && low < high; step++) {
        uint middle = (low + high + 1u) / 2u;
        if (breaking[middle].range.w <= corner) low = middle;
        else high = middle - 1u;
    }
    return low;
}

uint vertexOf(BreakingRecord object, uint corner) { return object.range.x + corner - object.range.w; }
bool isOfEarlierCut(BreakingRecord object, uint corner) { return corner - object.range.w >= object.range.y; }
