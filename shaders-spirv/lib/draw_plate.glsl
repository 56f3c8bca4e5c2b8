// Places about a blow in what is thin, where what it does spreads in two dimensions: how strongly it is strained falls with the
// distance r, and so their density, of a square meter, as r^(-4/3) (modules/brittle/effects/material.h). Hence as many lie within
// r as (r / furthest)^(2/3); those that would lie within the contact's radius lie there evenly. Wants draw and below
// (lib/draw.glsl), and lib/draw_impact.glsl.

// Of a radius that so many lie within, u being a share of them, of 2^32: furthest u^(3/2).
uint radiusInPlane(uint u, uint furthest) {
    uint64_t share = (uint64_t(u) * uint64_t(rootOf64(uint64_t(u) << 32))) >> 32;
    return uint((share * uint64_t(furthest)) >> 32);
}

// The same in space, where what is not in the thin wall is drawn again: density falls alike, so that u^(3/5) is left of the
// radius. Its first twelve bits are such that their fifth power is no more than the third of u's first twenty; `more` are those
// that follow.
uint radiusInSpace(uint u, uint more, uint furthest) {
    uint64_t cube = uint64_t(u >> 12) * uint64_t(u >> 12) * uint64_t(u >> 12);
    uint root = 0u;
    for (uint k = 0u; k < 12u; k++) {
        uint next = root | (2048u >> k);
        uint64_t square = uint64_t(next) * uint64_t(next);
        root = square * square * uint64_t(next) <= cube ? next : root;
    }
    return uint((uint64_t((root << 20) | (more >> 12)) * uint64_t(furthest)) >> 32);
}

// Grid steps along the two axes and out of the plane.
ivec3 offPlane(BreakingRecord object, int64_t across, int64_t along, int64_t out_) {
    ivec3 normal = ivec3(cross(vec3(object.across.xyz), vec3(object.along.xyz)) / 16384.0), p;
    for (uint k = 0u; k < 3u; k++)
        p[k] = int((across * int64_t(object.across[k]) + along * int64_t(object.along[k]) + out_ * int64_t(normal[k])) >> 14);
    return object.impact.xyz + p;
}

int depthOf(uint random, BreakingRecord object) { return int(below(random, uint(2 * object.along.w + 1))) - object.along.w; }

// A point of a disk has the direction and, where it is even, the radius as well.
bool drawOnPlate(uint site, uint attempt, BreakingRecord object, bool even, out ivec3 p) {
    ivec2 d = ivec2(below(draw(site, attempt, 0u), 65537u), below(draw(site, attempt, 1u), 65537u)) - 32768;
    uint square = uint(d.x * d.x) + uint(d.y * d.y), furthest = uint(object.low.w);
    uint radius = radiusInPlane(draw(site, attempt, 3u), furthest), core = uint(object.impact.w);
    bool is_core = even || radius < core;
    int64_t scale = int64_t(is_core ? (even ? furthest : core) : radius), divisor = int64_t(is_core ? 32768u : max(rootOf64(uint64_t(square)), 1u));
    p = offPlane(object, int64_t(d.x) * scale / divisor, int64_t(d.y) * scale / divisor, int64_t(depthOf(draw(site, attempt, 2u), object)));
    return square > 0u && square <= 1u << 30;
}

bool drawInShell(uint site, uint attempt, BreakingRecord object, out ivec3 p) {
    ivec3 d;
    bool in_ball = drawInBall(site, attempt, d);
    uint size = rootOf64(uint64_t(squaredLength(d))), core = uint(object.impact.w);
    uint radius = radiusInSpace(draw(site, attempt, 3u), mixed(size), uint(object.low.w));
    int64_t scale = int64_t(radius < core ? core : radius), divisor = int64_t(radius < core ? 32768u : max(size, 1u));
    p = object.impact.xyz + ivec3(int64_t(d.x) * scale / divisor, int64_t(d.y) * scale / divisor, int64_t(d.z) * scale / divisor);
    return in_ball;
}
