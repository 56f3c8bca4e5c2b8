// Two caps of one cell that coincide and face each other are a flap: a part of the cell that rounding left no thickness. Its
// key is the three corners and the cell. Wants pieces and suspects declared.

// Both sides of every suspect, one after the other.
uint suspectTriangle(uint k) { return suspects[k / 2u] + (k & 1u); }

uvec4 flapKey(uint t) {
    uvec4 p = pieces[t];
    uint low = min(min(p.x, p.y), p.z), high = max(max(p.x, p.y), p.z);
    return uvec4(low, p.x ^ p.y ^ p.z ^ low ^ high, high, p.w);
}

bool turnsUp(uint t) {
    uvec4 p = pieces[t], key = flapKey(t);
    uint after = p.x == key.x ? p.y : (p.y == key.x ? p.z : p.x);
    return after == key.y;
}

uint flapHash(uvec4 key) {
    uint hash = key.x * 0x9e3779b1u ^ (key.y * 0x85ebca6bu + (key.x >> 13)) ^ key.z * 0xc2b2ae35u ^ key.w * 0x27d4eb2fu;
    hash = (hash ^ (hash >> 15)) * 0x2c1b3c6du;
    return hash ^ (hash >> 13);
}
