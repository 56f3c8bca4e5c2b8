// Where two pieces touch, or may before the step is over. SI units.
#ifndef CONTACT_H
#define CONTACT_H

#include "gpu_types.h"

GPU_NAMESPACE_BEGIN

#define MANIFOLD_POINTS 4

struct ContactPoint {
    vec4 arm_a; // from A's center of mass to the point on A, world axes; w: separation along the normal, negative where they
                // overlap
    vec4 arm_b; // from B's center of mass to the point on B
    uvec4 id;   // feature, 0, 0, 0: the same from step to step while the same features touch
};

struct Manifold {
    uvec4 pair;  // piece a < piece b, body a, body b
    vec4 normal; // world, unit, from A to B; w: of a pair without points, a length that the hulls are apart for certain, or 0
    uvec4 info;  // points, feature of the separating axis, 0, 0
    ContactPoint points[MANIFOLD_POINTS];
};

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::ContactPoint) == 48 && sizeof(gpu::Manifold) == 240);
#endif
#endif
