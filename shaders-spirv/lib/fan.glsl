// Caps as fans, a workgroup a face: one corner is joined with all sides that do not end in it, which is how the paper
// (section 5) triangulates a convex polygon.
//
// No side has to know its neighbors for that. Seen as signed areas, the triangles of a fan add up to what the sides enclose,
// from any corner and with any number of loops, holes among them; and by their edges they are closed up to these sides. So if
// all of them turn left, none lies on another and together they are the cap: nothing else needs to be checked, and no loop be
// followed.
shared uvec4 sources[HUGE_FACE / 4]; // of the sides, one after the other
shared uint greatest, made;

uint first, n; // segments of the face

// Those that end where they begin are no sides.
bool isSide(uvec4 s) { return welded[s.x] != welded[s.y]; }

void loadSources(uint lane) {
    for (uint k = lane; k < (n + 3u) / 4u; k += GROUP_SIZE) {
        uvec4 four = uvec4(NO_INDEX);
        for (uint part = 0u; part < min(4u, n - 4u * k); part++) four[part] = segments[first + 4u * k + part].z;
        sources[k] = four;
    }
}

// The place of a side in its face: segments lie there as atomics left them, but their sources are what they are.
uint rankOf(uint source) {
    uvec4 lower = uvec4(0u);
    for (uint k = 0u; k < (n + 3u) / 4u; k++) lower += uvec4(lessThan(sources[k], uvec4(source)));
    return lower.x + lower.y + lower.z + lower.w;
}

void saveTriangle(uint slot, bool counts_, uint corner, uint a, uint b) {
    loose_caps[3u * slot] = counts_ ? corner : NO_INDEX;
    loose_caps[3u * slot + 1u] = a;
    loose_caps[3u * slot + 2u] = b;
    if (counts_) atomicAdd(made, 1u);
}
