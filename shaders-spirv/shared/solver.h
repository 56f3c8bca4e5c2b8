// What the kernels of the solver and the host agree on. SI units.
//
// Contacts are solved by sequential impulses with soft constraints (Catto, "Solver2D", 2024): a step is cut into substeps; in
// each, forces change velocities, the impulses of the last substep are applied again, contacts are solved with a soft push out
// of what overlaps, bodies move, and contacts are solved once more without the push, so that it leaves no energy behind.
// Contacts that share a moving body have different colors; those of one color are solved side by side.
//
// A soft contact gives way under a load as a spring does, which is what keeps piles calm: a hundred times the weight of a cube of
// a meter pushes it in by 28 mm. So each point follows, slowly, what it carries, and only what exceeds most of that (LOAD_CARRIED)
// makes it give way. Not all of it, or what bodies that are wedged press each other with would never die away; not at once
// (LOAD_FOLLOWED), or stacks would shake themselves down.
#ifndef SOLVER_H
#define SOLVER_H

#include "broad_phase.h"
#include "contact.h"
#include "gpu_types.h"

GPU_NAMESPACE_BEGIN

// Indices into the counts of dynamics, beyond those of the broad phase; laid out like those of a fracture event (fracture.h).
#define COUNT_CONTACTS 8      /* pairs with contact points */
#define COUNT_FRESH_PAIRS 12  /* whose points are to be found anew */
#define COUNT_FIRST_COLOR 16  /* then one for each of the wide colors */
#define COUNT_BODIES 24       /* of the world; none while all sleep */
#define COUNT_ONCE 25         /* 1; 0 while all sleep */
#define COUNT_AWAKE 26        /* bodies that move and do not sleep */
#define COUNT_SWIFT 27        /* contacts, where any body is fast for its size, else 0 */
#define COUNT_SOLVED_APART 28 /* workgroups that walk through contacts: one for every small island, one for what goes by color, if anything does */
#define COUNT_BLOWS 29        /* contacts that break something in this step */
#define COUNT_STRUCK 30       /* pairs, where there is such a contact, else 0 */
#define COUNT_TURNING 32      /* contacts that may, of bodies that turn on the way to each other */

// A bit of STATUS_FAILED: islands could not be joined.
#define FAILED_ISLANDS 16u

// A body, counted from 1, whose motion became no number in a step since this was last looked at; else 0.
#define STATUS_STOPPED_BODY (STATUS_NEEDED + COUNT_SWIFT)

// What the world counts beyond a step.
#define STEPS_MADE 0
#define STEPS_ASLEEP 1 /* in a row, in which nothing was awake, up to IDLE_STEPS */
#define STEPS_BODIES 2 /* slots of bodies that have ever held one: the first so many */
#define STEPS_PIECES 3
#define STEPS_BROKEN 4    /* bodies that have become fragments */
#define STEPS_FRAGMENTS 5 /* that have been made */
#define STEPS_EXPIRED 6   /* fragments that have gone after their time */
#define STEPS_WORDS 7
#define IDLE_STEPS 2

// The first colors hold most contacts and are dispatched each; the others are walked through by one workgroup. What has no
// color at all goes one by one in the end.
#define WIDE_COLORS 8
#define COLORS 64
#define NO_COLOR COLORS /* in order behind all others */
// Behind where the colors begin:
#define COLORS_USED (COLORS + 2)    /* how many there are, of all contacts */
#define COLORS_LACKED (COLORS + 3)  /* how many contacts have none */
#define COLORS_ORDERED (COLORS + 4) /* how many there are of contacts that go by color, those of large islands */
#define ISLANDS_APART (COLORS + 5)  /* how many islands go on their own */
#define COLOR_WORDS (COLORS + 6)
// With no more contacts than this, of the world or of an island, one workgroup walks through all colors: its barriers cost less
// than dispatches.
#define FEW_CONTACTS 1024

// The first pass of a substep notes blows; what is pressed in it is no blow to the passes after.
#define PUSH_FIRST 1
#define PUSH_AGAIN 2

#define HIT_LAST -1 /* what carries nothing, having been hit in the last substep: it may still be on its way in */
#define LOAD_CARRIED 0.75
#define LOAD_FOLLOWED 0.2 /* of the difference, a step */

// Impulses meet both bodies of a contact at one point (lib/solve_contact.glsl): whose arms follow the other's.
#define ARMS_OF_A_FOLLOW 0
#define ARMS_STAY 1 /* one of them does not move */
#define ARMS_OF_B_FOLLOW 2

// A body while it is solved. `moved` and `turned` count from the beginning of the step.
struct SolverBody {
    vec4 velocity; // w: inverse mass
    vec4 spin;     // w: inverse inertia, world axes: zz
    vec4 inertia;  // inverse, world axes: xx, xy, xz, yy
    vec4 moved;    // w: inverse inertia, world axes: yz
    vec4 turned;   // unit quaternion
};

struct SolverPoint {
    vec4 arm_a; // of the same point when the step began, if one follows the other; w: separation at the beginning of the step
    vec4 arm_b; // w: effective mass along the normal
    vec4 pulse; // impulse, the greatest of the step, speed of separation at the moment they meet, 1 after a blow
};

// A contact while it is solved, in the order of colors.
struct SolverContact {
    uvec4 ids;      // body a, body b, points, where it is remembered
    vec4 normal;    // from A to B; w: friction
    vec4 tangent;   // w: restitution
    vec4 center_a;  // mean of the arms; w: effective mass against twisting
    vec4 center_b;  // w: mean distance of the points from their center
    vec4 rub;       // impulses along the tangent, across it, of twisting; w: unused
    vec4 loads;     // of the points: what of their impulse does not make them give way
    vec4 rub_mass;  // effective mass in the tangent plane: 11, 12, 22; w: ARMS_*
    vec4 press[MANIFOLD_POINTS]; // effective mass of all points together along the normal: a symmetric matrix
    SolverPoint points[MANIFOLD_POINTS];
};

// A contact from step to step, one for every pair of the broad phase.
struct ContactMemory {
    uvec4 ids;     // body a, body b, points, color
    vec4 normal;   // w: friction
    vec4 tangent;  // w: restitution
    vec4 rub;      // as in SolverContact; w: whose arms follow, where both bodies move: ARMS_OF_*_FOLLOW
    vec4 turn_a;   // of the bodies when the points were found
    vec4 turn_b;
    vec4 place;    // of B's center of mass then, from A's, own axes of A; w: of a pair without points, how far the hulls were apart at the least
    vec4 anchor_a[MANIFOLD_POINTS]; // own axes of A; w: impulse
    vec4 anchor_b[MANIFOLD_POINTS]; // own axes of B; w: feature, as bits
    vec4 arm_a[MANIFOLD_POINTS];    // world axes, when the points were found; w: separation then
    vec4 arm_b[MANIFOLD_POINTS];    // w: what the point has carried of late, an impulse a substep; HIT_LAST after a blow
};

struct SolverPush {
    vec4 gravity;     // w: length of a substep, s
    vec4 soft;        // of two bodies that move: push per overlap, 1/s; share of the mass; share of the impulse; most push, m/s
    vec4 stiff;       // the same where one does not move; w: least speed that bounces, m/s
    uint color;       // the color, or the first of the rest
    uint with_push;   // 0, or, while overlap is pushed out, PUSH_*
    uint first_substep; // of its step: 1
    uint pad;
};

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::SolverBody) == 80 && sizeof(gpu::SolverPoint) == 48 && sizeof(gpu::SolverContact) == 384);
static_assert(sizeof(gpu::ContactMemory) == 368 && sizeof(gpu::SolverPush) == 64);
#endif
#endif
