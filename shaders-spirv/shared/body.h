// Rigid bodies. A place is a sector of space and an offset in it, so that it is as exact far from the origin as near it: two
// bodies are only ever compared by (difference of sectors) * SECTOR_EDGE + (difference of offsets). SI units.
#ifndef BODY_H
#define BODY_H

#include "gpu_types.h"

GPU_NAMESPACE_BEGIN

#define SECTOR_EDGE 16 /* m */

// Flags.
#define BODY_ASLEEP 1 /* it was not solved in the last step */
#define BODY_ABSENT 2 /* nothing is in this slot */
#define BODY_HANGS 4  /* something that does not move has held it back, and it does not tumble on */
#define BODY_ROUND 8  /* a ball, however few corners its hull has */
#define BODY_BORNE 16 /* others carried it in the last step, or the air: it fell no faster than before */
#define BODY_HELD 224 /* three bits: in how many steps in a row something that does not move held it back, up to seven */
#define BODY_HELD_ONCE 32

struct BodyState {
    ivec4 sector;  // w: BODY_* flags
    vec4 offset;   // of the center of mass, in [-8, 8) from the sector's middle; w: inverse mass, 0 for what does not move
    vec4 turn;     // unit quaternion x, y, z, w: own frame to world
    vec4 velocity; // of the center of mass; w: for how long the body has hardly moved, s
    vec4 spin;     // angular velocity, world axes
    vec4 momentum; // angular, world axes: the state; spin follows from it
};

struct BodyShape {
    uvec4 pieces;            // first piece, count, half the thickness of the thinnest piece as bits, 0
    vec4 inverse_inertia[3]; // rows, own axes, which are the principal ones: a diagonal; w: friction, restitution, radius about the center of mass that holds all pieces
};

#define PIECE_PLANE 1 /* bounds a half space: its hull lies wherever the other one is, below its body's own y axis */

struct PieceRecord {
    uvec4 ids; // hull, body, PIECE_* flags, 0
};

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::BodyState) == 96 && sizeof(gpu::BodyShape) == 64 && sizeof(gpu::PieceRecord) == 16);
#endif
#endif
