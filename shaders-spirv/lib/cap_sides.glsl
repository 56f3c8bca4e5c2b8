// Both sides of a cap: the lower cell's, and its mirror image for the other, always in a row. Those that may be one side of a flap
// are listed: only corners that fell together, or lie in one line, can make two caps of a cell coincide.

// Corners in one line, as those on a Voronoi edge: two faces that meet there may have the same sliver.
bool isThin(uvec3 t) {
    vec3 u = unit * (positions[t.y].xyz - positions[t.x].xyz), w = unit * (positions[t.z].xyz - positions[t.x].xyz), v = w - u;
    float longest = max(dot(u, u), max(dot(v, v), dot(w, w)));
    return length(cross(u, w)) <= 4.0 * step_size * sqrt(longest);
}

void saveBothSides(uint to, uvec3 cap, uint f) {
    bool flat_ = cap.x == cap.y || cap.y == cap.z || cap.z == cap.x;
    pieces[to] = uvec4(cap, flat_ ? NO_INDEX : face_cells[f]);
    pieces[to + 1u] = uvec4(cap.xzy, flat_ ? NO_INDEX : neighbors[f]);
    sources[to] = INNER_BIT | f;
    sources[to + 1u] = INNER_BIT | f;
    parents[to] = to;
    parents[to + 1u] = to + 1u;
    bool suspect = !flat_ && ((shared_points[cap.x] | shared_points[cap.y] | shared_points[cap.z]) != 0u || isThin(cap));
    if (suspect) suspects[atomicAdd(counts[COUNT_SUSPECTS], 1u)] = to;
}
