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
};

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::BreakingRecord) == 32);
#endif
#endif
