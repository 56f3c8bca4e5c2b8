// What breaks in a step, while it is made ready to be broken. Surfaces of bodies lie in the scene's pool of vertices, three for
// each triangle: first the body's own surface, then faces of earlier cuts. Corners that share a place are one vertex, and edges
// that share their ends one edge, as the host has them of a model (modules/brittle/mesh/topology.h).
#ifndef BREAKING_H
#define BREAKING_H

#include "fracture.h"
#include "gpu_types.h"

GPU_NAMESPACE_BEGIN

// Of an object that breaks, in the order of their tiles.
struct BreakingRecord {
    vec4 center;  // of its surface's box, in the frame of its vertices; w: units of half a grid's edge in a unit of theirs, a
                  // power of two
    uvec4 range;  // first vertex in the pool, corners of its own surface, of earlier cuts; its first corner of all that break
    ivec4 impact; // where it is hit, on its grid; w: contact radius, grid steps, at least 1
    ivec4 low;    // of its surface on its grid; w: to the furthest place of it from the impact
    ivec4 high;   // w: seed of its draws
    uvec4 sites;  // first of all that break, how many; of SITES_RADIAL spokes, and the ratio of a ring's radius to the last
                  // one's, of 2^16; of SITES_PAPER how often the candidate nearest to the blow is taken, of 2^32
    ivec4 across; // unit vector in the plane of what is flat, of 2^14; w: SITES_*
    ivec4 along;  // another one, at a right angle; w: grid steps from the middle plane, within which all of it lies
};

// How the sites of an object lie. Patterns are asked for, and what comes of them depends on the object's form.
#define SITES_SOLID 0     /* the even ones about the blow, the odd ones evenly (lib/draw_impact.glsl) */
#define SITES_FLAT 1      /* about the blow, in a plane (lib/draw_plate.glsl) */
#define SITES_SHELL 2     /* about the blow, in a thin wall that is not flat */
#define SITES_EVEN 3      /* evenly */
#define SITES_FLAT_EVEN 4 /* evenly, in a plane */
#define SITES_RADIAL 5    /* in sectors and rings about the blow, in a plane (lib/draw_radial.glsl) */
#define SITES_PAPER 6     /* as the paper has them (lib/draw_paper.glsl) */
// As BreakPattern of a scene has them; what is not thin and flat takes PATTERN_RADIAL for PATTERN_IMPACT.
#define PATTERN_IMPACT 0
#define PATTERN_UNIFORM 1
#define PATTERN_RADIAL 2
#define PATTERN_PAPER 3

// What of a body there is to break, for every slot of a body. Its surface keeps the frame in which it was made, however often
// what it bounds breaks: turning its vertices would round them.
struct BreakableBody {
    uvec4 surface; // first vertex in the pool, corners of its own surface, of earlier cuts; material, NO_INDEX for what does
                   // not break
    vec4 form;     // volume, all of its surface, strength; w: s, of the world's time until which no blow breaks it
    vec4 low;      // of its surface, frame of its vertices; w: of a fragment the slot of the first body that it was a part of
    vec4 high;     // w: PATTERN_*
    vec4 balance;  // center of mass, frame of its vertices; w: the step that it was made in, counted from 1, 0 for what has
                   // always been
    vec4 turn;     // from the frame of its vertices to its own axes
};

// Of a fragment: between any two of one body lay the plane halfway between their sites.
struct Birth {
    vec4 site; // of its cell, world axes, from the center of mass of what broke
    vec4 turn; // that its body had then
    uvec4 of;  // the slot of the body that broke, the step that it broke in, counted from 1, 0 for what is no fragment; how many
               // bodies have broken on the way to it
};

// A blow that breaks what it hits, where a pair's contact was. A body takes part in one blow a step at most, the first, so
// that who pays for its cracks is certain; the others wait for a step, as does what there is no room for.
struct BlowRecord {
    uvec4 sides; // BREAKS_*, 0 for what breaks nothing; y: as the bits of a float, when they meet, in steps from the beginning of this one, of all that meet by its end; z: 1 where nothing else comes first to either
    vec4 blow;   // effective mass, speed of meeting, its energy; w: share of the step that is over when they meet
    vec4 arm_a;  // of where it acts, world axes, as the bodies stand when the step begins
    vec4 arm_b;
    vec4 along; // normal, from A to B, when they meet
};

// A contact of bodies that turn on the way to each other: where and when they meet is found step by step, each time with the bodies
// standing as they will by then.
struct TurningBlow {
    uvec4 ids; // pair, the two bodies; w: 1 once it is known that they do not meet
    // s since the step began: when they meet as far as is known, and the latest time at which they are known to be apart; z: how far
    // then, m, 0: at none
    vec4 time;
};
#define MOST_BREAKING 256 /* bodies in a step, as many as there are tiles */
#define REACH_STEPS 1048576.0 /* of the furthest place from a blow: what its distance to the rim is counted in */
// The solver brakes bodies that would meet in the substep after the last: a blow is what happens by then.
#define AHEAD_OF_STEP 1.05 /* of a substep */
#define BREAKS_A 1
#define BREAKS_B 2

// What a body that breaks in this step was hit by, in the order of BreakingRecords.
struct BrokenBody {
    uvec4 ids;  // body, the one that it was hit by, NO_INDEX for a hand; pair, 1 where it is the pair's B
    vec4 blow;  // effective mass, speed of meeting, J that its cracks may take; w: impulse that they took, once it is known
    vec4 place; // of the blow, from the body's center of mass, its own axes; w: share of the step that is over when they meet
    vec4 along; // normal, from the body to the other
    vec4 share; // J, of the blow's energy that this body may spend, all of it; fragments that it pays for, room or no room; of
                // WHOLE_NO_PAIRS pairs and contacts, of WHOLE_TOO_LARGE triangles and sites that there is no room for
};

// What a blow has cost, in the order of BrokenBodies; with the first of two that break each other, for both.
struct CrackLedger {
    uvec4 outcome; // x: WHOLE_*, why the body did not become its fragments; 0 where it did; y: 1 where the first of two pays for it
    vec4 energies; // of the motion of both before and after, J that their cracks cost; w: m2 of this body's cracks
};

// Of an object that breaks, what of it is too small for a body, and how large what is not. Volumes in m3.
struct SizeShare {
    float dust;
    float dust_cells;
    float largest;
    float smallest;
};

// What the host is told of it. Of two that break each other, the first one's energies are those of both.
struct BreakEvent {
    uvec4 what;    // step, counted from 1; body, what hit it, NO_INDEX for a hand; its material
    uvec4 made;    // fragments that are bodies; 0, or WHOLE_*, why the body stayed whole; of what broke 1 where the event of what hit
                   // it pays for its cracks too; of WHOLE_FAILED the count of fracture
                   // that there was no room for and how much it would have been, 0 and 0 where it was something else
    uvec4 lacked;  // of WHOLE_NO_ROOM: bodies, pieces, faces of hulls, triangles that no range was found for; of WHOLE_NO_PAIRS:
                   // pairs, contacts; of WHOLE_TOO_LARGE triangles and sites of a step
    ivec4 sector;  // of the place of the blow; w: cells that were too small to be bodies
    vec4 offset;   // w: kg of these cells
    vec4 along;    // normal, from the body to the other; w: fragments that the blow pays for, more than there are sites for
                   // where the budget of one body has cut them short
    vec4 blow;     // effective mass, speed of meeting, J that its cracks may take; w: impulse that they took
    vec4 energies; // J, of the motion of both before and after, of the cracks; w: m2 of crack
    uvec4 born;    // the steps that the body and what hit it were made in, 0 for what has always been: somebody else may have their
                   // slots; of fragments the slots of the first bodies that they were parts of, of others their own
    vec4 sizes;    // kg, of the largest fragment and of the smallest
};
#define BREAK_EVENTS 1024 /* that are kept */

// Why a body that was hit hard enough stays whole.
#define WHOLE_NO_ROOM 1   /* pools of the world are full */
#define WHOLE_TOO_DEAR 2  /* its cells have more faces between them than the blow can pay for */
#define WHOLE_ONE_PIECE 3 /* all of it is one cell's */
#define WHOLE_FAILED 4    /* the step's event of fracture had no room for all that it met, or met what it cannot cut */
#define WHOLE_TOO_LARGE 5 /* no step has room for its surface or its sites: it never breaks */
#define WHOLE_NO_PAIRS 6  /* budgets have no room for the pairs and contacts that its fragments are expected to have */
// No body that was hit: a fragment that left the world. Only its place and who it was are told.
#define WHOLE_GONE 7

// Where a fragment goes: a slot of a body, a slot of a piece and its hull, the first face of the hull, the first triangle of
// the surface. Of vertices, edges and corners a hull has no more than so many for each of its faces: they begin in their pools
// at that many times its first face.
#define ROOM_BODY 0
#define ROOM_PIECE 1
#define ROOM_FACES 2
#define ROOM_TRIANGLES 3
// Instead of a body's slot, of cells of a body that broke which are too small to be bodies: they have no room, and are dust.
#define ROOM_OF_DUST 0xfffffffeu
#define VERTICES_A_FACE 2
#define EDGES_A_FACE 3
#define CORNERS_A_FACE 6

// Draws of a site: about the impact, then evenly in the box; a site that found no place by then is left out. Of each of the paper's
// candidates first of all.
#define PAPER_DRAWS 32
#define IMPACT_DRAWS 96
#define EVEN_DRAWS 160

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::BreakingRecord) == 128 && sizeof(gpu::BreakableBody) == 96 && sizeof(gpu::BrokenBody) == 80 &&
              sizeof(gpu::BlowRecord) == 80 && sizeof(gpu::TurningBlow) == 32);
static_assert(sizeof(gpu::CrackLedger) == 32 && sizeof(gpu::BreakEvent) == 160 && sizeof(gpu::SizeShare) == 16 &&
              sizeof(gpu::Birth) == 48);
#endif
#endif
