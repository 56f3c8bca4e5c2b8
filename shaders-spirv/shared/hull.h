// Hulls: convex pieces in the frame of their body, whose origin is its center of mass. SI units. All hulls share four pools; a
// hull is a range in each, and indices inside it count from its own first element.
#ifndef HULL_H
#define HULL_H

#include "gpu_types.h"

GPU_NAMESPACE_BEGIN

#define HULL_FACES 64
#define HULL_VERTICES 124
#define HULL_EDGES 186

struct HullRecord {
    uvec4 first; // vertex, face, corner, edge
    uvec4 count; // the same
    vec4 center; // inside the hull; w: radius of the ball about it that holds the hull
};

// A flat hull, such as a triangle of a static mesh, has two faces, which lie back to back. Where a neighbor goes on level behind a side
// of a triangle, nothing can come from there: that side is hidden.
struct HullFace {
    vec4 plane; // outward unit normal, height along it
    uvec4 loop; // first corner in the pool, corners, hidden sides of a triangle, 0; counterclockwise from outside. Bit v of the hidden
                // sides is that of the side that vertex v is not on
};

// The other pools: vertices as vec4; corners as uint, a vertex of the hull each; edges as uvec4, each edge once: from vertex,
// to vertex, the face on whose loop it runs that way (seen from outside it lies on the left), the face on the right.

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::HullRecord) == 48 && sizeof(gpu::HullFace) == 32);
#endif
#endif
