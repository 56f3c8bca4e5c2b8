// A cell as the cutting kernels leave it, small or large. Wants raw and cell_raw declared.
struct RawCell {
    uint status;
    uint plane_count;
    uint corner_count;
    uint planes;  // first word of the planes' ids; a plane that no corner uses has NO_INDEX
    uint triples; // first word of the corners
    bool wide;    // two words a corner instead of one
};

RawCell openCell(uint cell) {
    uvec2 at = cell_raw[cell];
    uint sizes = raw[at.x + 1u];
    uint planes = at.y == 0u ? RAW_PLANES : (at.y == 1u ? 256u : 2048u);
    return RawCell(raw[at.x], sizes & 0xffffu, sizes >> 16, at.x + 2u, at.x + 2u + planes, at.y != 0u);
}

uvec3 rawCorner(RawCell r, uint t) {
    uint first = raw[r.triples + (r.wide ? 2u * t : t)], second = raw[r.triples + (r.wide ? 2u * t + 1u : t)];
    uvec3 p = r.wide ? uvec3(first & 0xffffu, first >> 16, second)
                     : uvec3(first & 0xffu, (first >> 8) & 0xffu, first >> 16);
    return uvec3(raw[r.planes + p.x], raw[r.planes + p.y], raw[r.planes + p.z]);
}
