// Dust: what of a body that breaks is too small for a body flies on as particles. They lie in a ring, in the order in which
// they were made, so that the oldest are those that settle, and those that make room where there is none for more. SI units.
#ifndef DUST_H
#define DUST_H

#include "gpu_types.h"

GPU_NAMESPACE_BEGIN

struct DustParticle {
    ivec4 sector;  // as a body's; w: material
    vec4 place;    // offset in its sector; w: radius
    vec4 velocity; // w: mass, a whole number of DUST_GRAINs
    uvec4 birth;   // step that it was made in, counted from 1; the first body that it was a part of; 1 where it lies; 0
};

// What it bounces off, as what does not move: all below it is solid.
struct DustPlane {
    ivec4 sector;
    vec4 offset;
    vec4 normal;
};

#define MOST_PARTICLES_OF_A_CELL 8
// Below a plane by more than this a particle has begun there.
#define DUST_PLANE_DEPTH 10.0 /* m */

// Masses are added up in whole numbers of 64 bits, so that nothing depends on the order, and nothing is lost.
#define DUST_GRAIN_BITS 40 /* 2^-40 kg */

// Words of its state. Particles are numbered from 0, and from 0 again after 2^32; number n lies at n modulo the ring's length,
// a power of two.
#define DUST_FIRST 0       /* the oldest that flies */
#define DUST_NEXT 1        /* how many have been made */
#define DUST_AGED 2        /* that settled in this step */
#define DUST_SETTLED 3     /* how many have */
#define DUST_OVERWRITTEN 4 /* how many have been */
#define DUST_WAS_FIRST 5   /* before this step's event */
#define DUST_WAS_NEXT 6
#define DUST_ARGUMENTS 8  /* of a lane a particle that flies */
#define DUST_MADE_MASS 12 /* low word, high word */
#define DUST_SETTLED_MASS 14
#define DUST_OVERWRITTEN_MASS 16
#define DUST_WORDS 20

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::DustParticle) == 64 && sizeof(gpu::DustPlane) == 48);
#endif
#endif
