// What the kernels of the solver and the host agree on. SI units.
//
// Contacts are solved by sequential impulses with soft constraints (Catto, "Solver2D", 2024): a step is cut into substeps; in
// each, forces change velocities, the impulses of the last substep are applied again, contacts are solved with a soft push out
// of what overlaps, bodies move, and contacts are solved once more without the push, so that it leaves no energy behind.
// Contacts that share a moving body have different colors; those of one color are solved side by side.
//
// A soft contact gives way under a load: contacts of a stack of n cubes with the edge e by g n^2 / (e hertz^2) of an edge
// together, and stiffness must stay below an eighth of the substeps a second. So an island takes as many substeps as its loads,
// sizes and height call for (lib/pace.glsl), if one workgroup can walk through it; others take those of the settings.
#ifndef SOLVER_H
#define SOLVER_H

#include "broad_phase.h"
#include "contact.h"
#include "gpu_types.h"

GPU_NAMESPACE_BEGIN

// Indices into the counts of dynamics, beyond those of the broad phase; laid out like those of a fracture event (fracture.h).
#define COUNT_CONTACTS 8     /* pairs with contact points */
#define COUNT_FRESH_PAIRS 12 /* whose points are to be found anew */
#define COUNT_BY_COLOR 13    /* 1 where contacts are solved color by color, those of large islands; else 0 */
#define COUNT_FIRST_COLOR 16 /* then one for each of the wide colors */
#define COUNT_BODIES 24      /* of the world; none while all sleep */
#define COUNT_ONCE 25        /* 1; 0 while all sleep */
#define COUNT_AWAKE 26       /* bodies that move and do not sleep */
#define COUNT_SWIFT 27       /* contacts, where any body is fast for its size, else 0 */
#define COUNT_SOLVED_APART                                                                                                     \
    28 /* workgroups that walk through contacts: one for every small island, one for what goes by color, if anything does */
#define COUNT_BLOWS 29      /* contacts that break something in this step */
#define COUNT_STRUCK 30     /* pairs, where there is such a contact, else 0 */
#define COUNT_UNFINISHED 31 /* workgroups of small islands, where one of them needs another dispatch, else 0; only in args */
#define COUNT_TURNING 32    /* contacts that may, of bodies that turn on the way to each other */

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
// Dispatches of a step of small islands, where a lane may take few turns (lib/pace.glsl).
#define ISLAND_PARTS 16

// A point that comes in faster than this is hit by a blow (lib/blow_speed.glsl).
#define BLOW_FALLS 6.116208 /* times the speed that gravity gives in a step */
#define BLOW_SHARE 0.02     /* of the shorter arm, in a step, */
#define BLOW_SPEED 1.0      /* m/s, but no more than this. Gravity may call for more. */

// The frequency of a contact, times a substep. A stiffer contact would not come to rest.
#define STIFFEST 0.125

// Sweeps over contacts: while overlap is pushed out, and without. The first one of each kind notes how points are; the first of
// a substep notes blows, too: what is pressed in it is no blow to the sweeps after.
#define RELAX_FIRST 0
#define PUSH_FIRST 1
#define PUSH_AGAIN 2
#define RELAX_AGAIN 3

// What a point has carried of late counts as carried, in large islands and heaps: only what exceeds most of it makes it give
// way. Stacks would sway by it: small islands that are no heaps take more substeps instead, and do without.
#define LOAD_CARRIED 0.75
#define LOAD_FOLLOWED 0.2 /* of the difference, a step */
// State of a point: whether it pressed when sweeps of this kind began; and, added to that, how fast it came in in this substep.
#define POINT_PRESSED 0.0
#define POINT_FREE 1.0
#define POINT_MET 2.0     /* faster than a load comes in that is known */
#define POINT_HIT 4.0     /* by a blow */
#define MEETING_SHARE 0.1 /* of the speed of a blow: from there on a point is met */
#define HIT_LAST -1.0     /* instead of a load: the point was hit in the last substep */

// Impulses meet both bodies of a contact at one point (lib/solve_contact.glsl): whose arms follow the other's.
#define ARMS_OF_A_FOLLOW 0
#define ARMS_STAY 1 /* one of them does not move */
#define ARMS_OF_B_FOLLOW 2

// Components of what a sweep has done to a contact (solve_islands). Made again, its change of impulses would gain the first and
// lose the second, in J. The others are the greatest change of an impulse and the greatest impulse, in N s.
#define SWEEP_GAIN 0
#define SWEEP_LOSS 1
#define SWEEP_CHANGE 2
#define SWEEP_PRESSED 3

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
    vec4 pulse; // impulse, the greatest of the step, speed of separation at the moment they meet, POINT_*
};

// A contact while it is solved, in the order of colors.
struct SolverContact {
    uvec4 ids;     // body a, body b, points, where it is remembered
    vec4 normal;   // from A to B; w: friction
    vec4 tangent;  // w: restitution
    vec4 center_a; // mean of the arms; w: effective mass against twisting
    vec4 center_b; // w: mean distance of the points from their center
    vec4 rub;      // impulses along the tangent, across it, of twisting; w: the most that overlap is pushed out with, m/s
    vec4 rub_mass; // effective mass in the tangent plane: 11, 12, 22; w: ARMS_*
    vec4 loads;    // of the points: what of their impulse does not make them give way
    uvec4 pace;    // substeps of its last step, 0 if it is new; of this one; 1: carries loads; 1: is uneven (lib/pace.glsl)
    vec4 first;    // impulses of the points when the substep began
    // Of sweeps that go on until bodies part (solve_islands): of the points before the last one,
    vec4 before;                 // impulses
    vec4 lacks;                  // speeds of separation that they lacked; behind the sweep SWEEP_*
    vec4 press[MANIFOLD_POINTS]; // effective mass of all points together along the normal: a symmetric matrix
    SolverPoint points[MANIFOLD_POINTS];
};

// A contact from step to step, one for every pair of the broad phase.
struct ContactMemory {
    uvec4 ids;    // body a, body b, points, color
    vec4 normal;  // w: friction
    vec4 tangent; // w: restitution
    vec4 rub;     // as in SolverContact; w: whose arms follow, where both bodies move: ARMS_OF_*_FOLLOW
    vec4 turn_a;  // of the bodies when the points were found
    vec4 turn_b;
    uvec4 pace; // substeps of the step that it was last solved in; 0 if it was not
    vec4 place; // of B's center of mass then, from A's, own axes of A; w: of a pair without points, how far the hulls were
                // apart at the least
    vec4 anchor_a[MANIFOLD_POINTS]; // own axes of A; w: impulse
    vec4 anchor_b[MANIFOLD_POINTS]; // own axes of B; w: feature, as bits
    vec4 arm_a[MANIFOLD_POINTS];    // world axes, when the points were found; w: separation then
    vec4 arm_b[MANIFOLD_POINTS];    // w: what the point has carried of late, an impulse a substep; HIT_LAST after a blow
};

struct SolverPush {
    vec4 gravity;   // w: length of a substep, s
    vec4 soft;      // of two bodies that move: push per overlap, 1/s; share of the mass; share of the impulse; w: unused
    vec4 stiff;     // the same where one does not move; w: least speed that bounces, m/s
    uint color;     // the color, or the first of the rest
    uint with_push; // PUSH_* or RELAX_*
    uint first_substep; // of its step: 1
    uint substeps;      // of a step, at the least
};

// For prepare_contacts.
struct PreparePush {
    vec4 gravity;     // w: length of a substep, s
    uint substeps;    // of a step, at the least
    float most_push;  // m/s, that overlap is pushed out with,
    float push_share; // or so much of the shorter arm in a step, if that is more
};

// For small islands, whose substeps the device chooses.
struct PacePush {
    vec4 gravity;         // w: length of the step, s
    float hertz, damping; // of the spring between bodies that move, with `substeps`
    // Each contact has the speed that overlap is pushed out with (SolverContact::rub).
    float least_bounce;   // m/s
    uint substeps;        // at the least
    uint most_substeps;
    uint iterations;
    uint part, parts; // of the dispatches of a step
    uint most_parts;  // that islands may take substeps for
    float stiffer;    // times the substeps that loads call for
    uint heaps_too;   // 1: heaps get all substeps that they call for, as stacks do
};

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::SolverBody) == 80 && sizeof(gpu::SolverPoint) == 48 && sizeof(gpu::SolverContact) == 448);
static_assert(sizeof(gpu::ContactMemory) == 384 && sizeof(gpu::SolverPush) == 64 && sizeof(gpu::PacePush) == 64);
#endif
#endif
