// Debris: small fragments at rest fade and leave the world, or leave it at once where room for fragments runs short. They give back
// what they had of the pools.
#ifndef DEBRIS_H
#define DEBRIS_H

#include "gpu_types.h"

GPU_NAMESPACE_BEGIN

// Of a slot of a body.
struct DebrisClock {
    ivec4 sector; // where its fragment was a step ago; w: the step that it was made in, or DEBRIS_LEAVES while it goes
    vec4 offset;  // w: s, for how long its center of mass has hardly moved, DEBRIS_OVER where its time is over
};
#define DEBRIS_OVER 1e30
#define DEBRIS_LEAVES (-1)

#define MOST_EXPIRING 256 /* in a step; the others a step later */

// Words of a step.
#define DEBRIS_LISTED 0 /* how many go */
#define DEBRIS_LIST_ARGUMENTS 4
#define DEBRIS_PAIR_ARGUMENTS 8
#define DEBRIS_GO_ARGUMENTS 12
#define DEBRIS_RETURN_ARGUMENTS 16
#define DEBRIS_TELL_ARGUMENTS 20
#define DEBRIS_WORDS 24

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::DebrisClock) == 32);
#endif
#endif
