// What the host is told of blows that broke nothing: contacts that were met faster than a threshold. For sound, sparks and damage
// of its own.
#ifndef IMPACT_H
#define IMPACT_H

#include "gpu_types.h"

GPU_NAMESPACE_BEGIN

struct ImpactEvent {
    uvec4 what;    // step, counted from 1; the two bodies, the lower slot first; how many points of theirs were hit
    uvec4 born;    // the steps that they were made in, 0 for what has always been; of fragments the slots of the first bodies that
                   // they were parts of, of others their own
    ivec4 sector;  // of the middle of these points, on the body that moves less
    vec4 offset;
    vec4 along;    // normal, from the first to the second
    vec4 measures; // kg, effective mass there; m/s, speed of meeting along the normal; J of both; N s that have changed it
};

#define IMPACT_EVENTS 1024 /* that are kept */
#define MOST_IMPACTS 256   /* of a step: the hardest */

// Words of what has been told.
#define IMPACTS_TOLD 0 /* so far */
#define IMPACTS_WEAK 1 /* that were left out for harder ones of their steps, so far */
#define IMPACTS_HIT 2  /* in this step */
#define IMPACT_WORDS 4

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::ImpactEvent) == 96);
#endif
#endif
