// Sides of vast faces by the corner where they begin: they lie in the order of its name. Wants vast_ends and vast_faces.

// The first side of the face that begins there, or at a name above it.
uint firstSideAt(uint j, uint name) {
    uint low = vast_faces[j].first, high = low + vast_faces[j].count;
    for (uint step = 0u; step < 32u && low < high; step++) {
        uint middle = (low + high) / 2u;
        bool below = vast_ends[middle].x < name;
        low = below ? middle + 1u : low;
        high = below ? high : middle;
    }
    return low;
}

bool beginsAt(uint side, uint j, uint name) {
    return side < counts[COUNT_VAST_SIDES] && vast_ends[side].x == name && vast_ends[side].w == j;
}

// The end of the sides that begin there, of which the first is given.
uint endOfSidesAt(uint first, uint j, uint name) {
    uint end = first;
    bool goes_on = beginsAt(end, j, name);
    for (uint step = 0u; step < MOST_TURNS / 3u && goes_on; step++) {
        end++;
        goes_on = beginsAt(end, j, name);
    }
    return end;
}
