// What the kernels of the narrow phase and their recorder share.
#ifndef NARROW_PHASE_H
#define NARROW_PHASE_H

#include "gpu_types.h"

// Contacts are looked for at no more than this share of the radius of the smaller hull. A wider margin would hold a chip off
// the ground.
#define MARGIN_SHARE 0.1

GPU_NAMESPACE_BEGIN

// Kinds of separating axes, in the upper byte of a feature. The rest: a face, two edges (A's << 8 | B's), or a direction.
#define AXIS_APART 0u
#define AXIS_FACE_A 1u
#define AXIS_FACE_B 2u
#define AXIS_EDGES 3u
#define AXIS_FIXED 4u
#define AXIS_KIND_SHIFT 24u
#define AXIS_GRAZES 0x10000u     /* of a face: along it the hulls overlap by a thin strip only (lib/graze.glsl) */
#define AXIS_LEVEL 0x20000u      /* of a face of a triangle: the axis that was found leads to a hidden side (lib/hidden_side.glsl) */
#define NO_HIT 0xffffffffu
#define AXIS_UNKNOWN 0xffffffffu /* a feature: nobody has found the axis yet */

// The axis along which a pair touches, in the frame of A: its body's axes, from the center of A's hull.
struct AxisRecord {
    vec4 axis;  // unit, from A to B; w: separation along it where B has gone by the shift
    vec4 shift; // of B, to the time of impact; w: height of the reference hull along its own outward normal
    uvec4 info; // feature, reference hull (0 is A), its face, the other's face
};

// The pairs in which a body first touches a fixed body and a moving one in a step. NO_HIT if it touches none.
struct FirstHits {
    uint fixed_order; // the lower, the earlier (lib/first_hit.glsl)
    uint fixed_pair;
    uint moving_order;
    uint moving_pair;
};

struct NarrowPhasePush {
    vec4 gravity;      // that what moves falls with in the step
    float speculative; // m
    float duration;    // of the step in seconds; 0: nothing is swept
    uint capacity;     // pairs
    uint count_at;     // the word of the counts that says how many there are
    uint fixed_axes;   // directions, of find_fixed_axes
    float step;        // s
    float strip;       // m: hulls that overlap by less graze each other; 0: none do
    uint hides;        // 1: what is touched first hides sides (lib/hidden_hit.glsl)
};

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::AxisRecord) == 48 && sizeof(gpu::FirstHits) == 16 && sizeof(gpu::NarrowPhasePush) == 48);
#endif
#endif
