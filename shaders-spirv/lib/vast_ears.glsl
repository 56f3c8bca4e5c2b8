// Cuts a corner off a part of a vast face. Wants lib/vast_halves.glsl and lib/vast_sides.glsl.
void cutEar(uint h) {
    uvec2 around = vast_halves[h];
    uint a = originOf(around.y), k = originOf(h), c = originOf(around.x);
    vast_caps[3u * h] = vast_ends[a].x;
    vast_caps[3u * h + 1u] = vast_ends[k].x;
    vast_caps[3u * h + 2u] = vast_ends[c].x;
    vast_flags[h] = 1u;
    if (turn(placeOf(a), placeOf(k), placeOf(c)) < 0) atomicAdd(counts[STATUS_TURNED_OVER], 1u);
    vast_halves[around.y].x = around.x;
    vast_halves[around.x].y = around.y;
    vast_halves[h] = uvec2(NO_INDEX);
}
