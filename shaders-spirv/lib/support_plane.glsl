// Planes that bound a fragment from outside, from its height along a normal of whole numbers.
//
// Places are rounded to the sixteenth of a grid step, relative to the grid's center (HEIGHT_BITS), so that heights are whole
// numbers too. Rounding moves a place by at most half a unit along each axis, and with that the height by at most half the sum
// of the normal's components, which the plane makes up for: it never cuts into the fragment. In the form that cells are cut in,
// d.w <= r with w = 2 (v - site). Normals have at most 22 bits, as differences of sites have 25, so the widths named in
// lib/wide.glsl hold.
#include "lib/tile.glsl"

const int kGridMiddle = 1 << 23;

ivec3 fineOf(vec3 position, float fine) { return ivec3(roundEven(position * fine)); }

int64_t heightAlong(ivec3 d, ivec3 p) {
    return int64_t(d.x) * int64_t(p.x) + int64_t(d.y) * int64_t(p.y) + int64_t(d.z) * int64_t(p.z);
}

int64_t boundOf(ivec3 d, int64_t height, ivec3 site) {
    int slack = (abs(d.x) + abs(d.y) + abs(d.z)) / 2 + 8;
    return ((height + int64_t(slack)) >> 3) - int64_t(2) * heightAlong(d, inTile(site) - ivec3(kGridMiddle));
}

// Along one of the fixed directions: normals of eight times its components.
int64_t boundAlong(ivec3 n, int height, ivec3 site) { return boundOf(8 * n, int64_t(8) * int64_t(height), site); }
