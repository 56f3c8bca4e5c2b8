// Places in sectors and rings about a blow on a plate: all rings have their places at the same angles, and all sectors at the same
// radii, so that what parts cells are spokes through the blow and pieces of rings. Angles are moved by up to a quarter of a sector
// either way. Wants what lib/draw_plate.glsl wants, and lib/sine_hash.glsl.
#define RADIAL_DRAWS 24 /* of a place through the thickness; what finds none lies beside the plate */

bool drawRadial(uint site, uint attempt, BreakingRecord object, out ivec3 p) {
    uint spokes = max(object.sites.z, 1u), spoke = site % spokes, ring = site / spokes, sector = 0xffffffffu / spokes;
    uint angle = spoke * sector + below(draw(0x10000u + spoke, 0u, 0u), sector / 2u);
    uint64_t radius = uint64_t(object.impact.w);
    for (uint k = 0u; k < ring && radius < uint64_t(1u << 26); k++) radius = (radius * uint64_t(object.sites.w)) >> 16;
    int64_t along = int64_t(radius) * int64_t(sineOf(angle)) >> 30, across = int64_t(radius) * int64_t(sineOf(angle + 0x40000000u)) >> 30;
    p = offPlane(object, across, along, int64_t(depthOf(draw(site, attempt, 2u), object)));
    return attempt < RADIAL_DRAWS && radius < uint64_t(1u << 26);
}
