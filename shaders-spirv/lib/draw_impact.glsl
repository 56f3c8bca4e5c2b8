// Places about an impact: their density is even within the contact radius r0 and falls as r^-4 outside. The radius comes from the
// inverse of its cumulated density, u = (r / r0)^3 / 3 up to r0, then 4/3 - r0 / r; a point drawn evenly from a ball has the
// direction and, within r0, the radius as well. Wants draw and below (lib/draw.glsl), and lib/wide.glsl.
#include "lib/integer_root.glsl"

// A point of the ball of radius 2^15, or, three times in seven, none.
bool drawInBall(uint site, uint attempt, out ivec3 d) {
    d = ivec3(below(draw(site, attempt, 0u), 65537u), below(draw(site, attempt, 1u), 65537u), below(draw(site, attempt, 2u), 65537u)) - 32768;
    int64_t square = squaredLength(d);
    return !isNegative((int64_t(1) << 30) - square) && d != ivec3(0);
}

// `impact`: w, its contact radius. False where this draw gives no place.
bool drawAbout(uint site, uint attempt, ivec4 impact, uint furthest, out ivec3 p) {
    ivec3 d;
    bool in_ball = drawInBall(site, attempt, d);
    // u of 2^32 runs from 0 to 4/3 - r0 / furthest; the core has a third.
    uint64_t one = uint64_t(1) << 32, radius = uint64_t(impact.w);
    uint64_t range = 4ul * one / 3ul - (radius << 32) / uint64_t(furthest);
    uint64_t u = (uint64_t(draw(site, attempt, 3u)) * (range >> 1)) >> 31; // the product has 64 bits
    bool core = (u >> 32) == 0ul && uint(u) < 0x55555555u;
    uint64_t tail = (radius << 32) / max(4ul * one / 3ul - u, 1ul);
    uint size = rootOf64(uint64_t(squaredLength(d)));
    int64_t scale = int64_t(core ? radius : tail);
    int64_t divisor = int64_t(core ? 32768u : max(size, 1u));
    p = impact.xyz + ivec3(int64_t(d.x) * scale / divisor, int64_t(d.y) * scale / divisor, int64_t(d.z) * scale / divisor);
    return in_ball;
}
