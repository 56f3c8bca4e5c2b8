// A place that moves on: whole sectors go over from the offset, which stays in [-SECTOR_EDGE / 2, SECTOR_EDGE / 2). Wants
// shared/body.h.
ivec3 sectorsIn(vec3 offset) { return ivec3(floor(offset / float(SECTOR_EDGE) + 0.5)); }
vec3 offsetWithin(vec3 offset, ivec3 sectors) { return offset - vec3(sectors) * float(SECTOR_EDGE); }
