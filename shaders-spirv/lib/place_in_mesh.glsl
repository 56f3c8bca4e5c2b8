// Random places on the event's grid. Integers only, keyed by (seed, site, try), so that every device places the same sites.
//
// Wants raw_sites and placed, and what lib/inside_solid.glsl wants, declared.
layout(push_constant) uniform Push {
    ivec4 low;    // of the mesh on the grid; w: edge of a column
    ivec4 high;   // w: columns in a row
    ivec4 impact; // where the solid is hit; w: contact radius
    uint site_count;
    uint occupied;
    uint seed_low;
    uint seed_high;
    uint first_try;
    uint triangle_count;
    uint favor; // of 2^32: how often the candidate nearest to the impact is taken
    uint furthest; // place in the mesh, from the impact
    uint tallest;  // column: the most that lies between the lowest and the highest z of one
    uint candidates; // a site, of the paper's pattern
};
#include "lib/draw.glsl"
#include "lib/inside_solid.glsl"

void place(uint site, ivec3 p) {
    raw_sites[3u * site] = uint(p.x);
    raw_sites[3u * site + 1u] = uint(p.y);
    raw_sites[3u * site + 2u] = uint(p.z);
    placed[site] = 1u;
}
