// Places as the paper draws them (section 2, figure 2): on a triangle by three steps of interpolation, a side, the opposite corner,
// the center of the box. Random numbers are those of lib/sine_hash.glsl, keyed by candidate and try. Wants lib/draw.glsl.
#include "lib/sine_hash.glsl"

// On the way from a to b; `share` of 2^32.
ivec3 between(ivec3 a, ivec3 b, uint share) {
    ivec3 d = b - a;
    return a + ivec3((int64_t(d.x) * int64_t(share)) >> 32, (int64_t(d.y) * int64_t(share)) >> 32, (int64_t(d.z) * int64_t(share)) >> 32);
}

struct PaperKey {
    uint x, y;
};

PaperKey keyOf(uint candidate, uint attempt) { return PaperKey(candidate + seed_low, attempt * 4u + seed_high); }

uint triangleFor(PaperKey key, uint triangles) { return below(sineHash(key.x, key.y), triangles); }

ivec3 placeBy(PaperKey key, ivec3 a, ivec3 b, ivec3 c, ivec3 middle) {
    ivec3 on_side = between(a, b, sineHash(key.x, key.y + 1u)), on_triangle = between(c, on_side, sineHash(key.x, key.y + 2u));
    return between(middle, on_triangle, sineHash(key.x, key.y + 3u));
}

bool takesNearest(uint site, uint favor) { return draw(site, 0u, 0u) < favor; }
