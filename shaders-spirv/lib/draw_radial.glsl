// Places in sectors and rings about a blow on a plate. All rings have their sites at the same angles, and all sectors at the same
// radii: of two sectors' sites those of one ring are mirrored about the spoke between them, so that what parts cells are exactly
// spokes through the blow, and pieces of rings that meet on these. Angles are moved by up to a quarter of a sector either way.
//
// That holds up to the rim only if sites beyond it are there as well: a site is wanted where its cell has a part in the object,
// be the site itself outside. All lie in the middle plane, so that cracks go straight through the plate. A cell is looked for in RADIAL_DRAWS places; what has but a sliver in the object is found in none,
// and its neighbors share it. Wants what lib/draw_plate.glsl wants, and lib/sine_hash.glsl.
#define RADIAL_ANGLES 6u
#define RADIAL_DEPTHS 4u /* of a ring */
#define RADIAL_DRAWS (RADIAL_ANGLES * RADIAL_DEPTHS)

const uint kMostRadius = 1u << 26; // grid steps: outside of every object

uint spokesOf(BreakingRecord object) { return max(object.sites.z, 1u); }

// Of 2^32.
uint angleOf(uint spoke, BreakingRecord object) {
    uint sector = 0xffffffffu / spokesOf(object);
    return spoke * sector + below(draw(0x10000u + spoke, 0u, 0u), sector / 2u);
}

uint64_t radiusOf(uint ring, BreakingRecord object) {
    uint64_t radius = uint64_t(object.impact.w);
    for (uint k = 0u; k < ring && radius < uint64_t(kMostRadius); k++) radius = (radius * uint64_t(object.sites.w)) >> 16;
    return radius;
}

ivec3 atAngle(uint64_t radius, uint angle, int out_, BreakingRecord object) {
    int64_t across = int64_t(radius) * int64_t(sineOf(angle)) >> 30, along = int64_t(radius) * int64_t(sineOf(angle + 0x40000000u)) >> 30;
    return offPlane(object, across, along, int64_t(out_));
}

ivec3 radialSite(uint site, BreakingRecord object) {
    uint spokes = spokesOf(object);
    return atAngle(radiusOf(site / spokes, object), angleOf(site % spokes, object), 0, object);
}

// A place of its cell: between two spokes, each halfway to the next angle, and two lines across the site's, halfway to the next
// radius.
ivec3 placeInSector(uint site, uint attempt, BreakingRecord object) {
    uint spokes = spokesOf(object), spoke = site % spokes, ring = site / spokes;
    uint angle = angleOf(spoke, object), next = (spoke + 1u) % spokes, last = (spoke + spokes - 1u) % spokes;
    uint part = attempt % RADIAL_ANGLES, step = 2u * (part / 2u) + 1u; // 1, 3, 5 of 6, on either side
    bool left = (part & 1u) != 0u;
    uint half_sector = (left ? angle - angleOf(last, object) : angleOf(next, object) - angle) / 2u;
    uint turn = half_sector / (RADIAL_ANGLES) * step;
    uint64_t radius = radiusOf(ring, object), low = ring == 0u ? 0ul : (radius + radiusOf(ring - 1u, object)) / 2ul;
    uint64_t high = (radius + radiusOf(ring + 1u, object)) / 2ul;
    uint64_t way = low + (high - low) * uint64_t(2u * (attempt / RADIAL_ANGLES) + 1u) / uint64_t(2u * RADIAL_DEPTHS);
    int cosine = max(sineOf(turn + 0x40000000u), 1 << 27);
    uint64_t on_ray = (way << 30) / uint64_t(cosine);
    return atAngle(on_ray, left ? angle - turn : angle + turn, depthOf(draw(site, attempt, 3u), object), object);
}
