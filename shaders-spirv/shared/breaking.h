// What breaks in a step, while it is made ready to be broken. Surfaces of bodies lie in the scene's pool of vertices, three for each
// triangle: first the body's own surface, then faces of earlier cuts. Corners that share a place are one vertex, and edges
// that share their ends one edge, as the host has them of a model (modules/brittle/mesh/topology.h).
#ifndef BREAKING_H
#define BREAKING_H

#include "fracture.h"
#include "gpu_types.h"

GPU_NAMESPACE_BEGIN

// Of an object that breaks, in the order of their tiles.
struct BreakingRecord {
    vec4 center; // of its surface's box, in the frame of its vertices; w: units of half a grid's edge in a unit of theirs, a power of two
    uvec4 range; // first vertex in the pool, corners of its own surface, of earlier cuts; its first corner of all that break
    ivec4 impact; // where it is hit, on its grid; w: contact radius, grid steps, at least 1
    ivec4 low;    // of its surface on its grid; w: to the furthest place of it from the impact
    ivec4 high;   // w: seed of its draws
    uvec4 sites;  // first of all that break, how many
};

// Draws of a site: about the impact, then evenly in the box; a site that found no place by then is left out.
#define IMPACT_DRAWS 96
#define EVEN_DRAWS 160

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::BreakingRecord) == 96);
#endif
#endif
