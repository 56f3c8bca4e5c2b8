// Objects that break at once each have a grid of their own, in tiles so far apart that no cell of one looks for sites in another:
// a cell reaches no further than across its box, and looks for sites no further than twice that (shared/fracture.h). A place on
// the grid tells its tile by its upper bits; ways between places of one tile are those within its grid.
#ifndef TILE_GLSL
#define TILE_GLSL

ivec3 tileOf(ivec3 place) { return place & ~TILE_MASK; }
ivec3 inTile(ivec3 place) { return place & TILE_MASK; }
ivec3 tileAt(uint number) { return ivec3(int(number) % TILES_IN_ROW, int(number) / TILES_IN_ROW, 0) << TILE_BITS; }
uint tileNumber(ivec3 place) { return uint((place.y >> TILE_BITS) * TILES_IN_ROW + (place.x >> TILE_BITS)); }

#endif
