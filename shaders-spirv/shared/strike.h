// Blows that a host gives by hand: it says where, how wide and how much, and a body that is near enough is struck as if it had met a
// ball as wide there.
#ifndef STRIKE_H
#define STRIKE_H

#include "gpu_types.h"

GPU_NAMESPACE_BEGIN

#define MOST_STRIKES 32 /* in a step */

// Which of two is the pair's that a body was hit in: strikes have none.
#define STRUCK_BY_HAND 0x80000000u

struct Strike {
    ivec4 sector;
    vec4 offset; // w: radius, m
    vec4 energy; // J, of all that are struck together
};

// The hardest blow by hand that breaks the body of a slot. It waits here while a step has no room for what the body breaks into.
struct StrikeRecord {
    uvec4 what; // 1 if there is one; which strike of its step it was; the step in which the body was made (bornIn)
    vec4 blow;  // effective mass, speed of meeting, its energy, 0
    vec4 arm;   // from the center of mass to the place that is struck, own axes; w: radius, m
    vec4 along; // from the body to what strikes it, own axes
};

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::Strike) == 48 && sizeof(gpu::StrikeRecord) == 64);
#endif
#endif
