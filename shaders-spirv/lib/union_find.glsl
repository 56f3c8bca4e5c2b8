// Disjoint sets with links that only ever lead down: the root of a set is its lowest member, whatever the order of unions.
// Wants parents declared.
uint rootOf(uint x) {
    uint p = parents[x];
    for (uint guard = 0u; guard < 8192u && p != x; guard++) {
        uint further = parents[p];
        parents[x] = further;
        x = p;
        p = further;
    }
    return x;
}

// False where others kept moving the roots: as good as never.
bool unite(uint a, uint b) {
    bool joined = false;
    for (uint guard = 0u; guard < 256u && !joined; guard++) {
        a = rootOf(a);
        b = rootOf(b);
        uint low = min(a, b), high = max(a, b);
        uint held = low == high ? high : atomicMin(parents[high], low);
        joined = held == high; // it was a root still, and is linked now
        a = held;
        b = low;
    }
    return joined;
}
