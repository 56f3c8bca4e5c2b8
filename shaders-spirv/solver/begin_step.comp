// A step begins: what the solver wants of each body, slowed by the air where there is any, and whether any is fast for its size
// (lib/held_way.glsl).
//
// Speeds lag places by half a substep (lib/approach.glsl), those that bodies start with too, from the first step on: so what is
// dropped falls for as long, and has turned as far when it lands, however long a step is. Where there are contacts push_bodies takes
// that back: what rests has no speed to lag.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/rigid.glsl"
#include "lib/held_way.glsl"
#include "lib/effect.glsl"
#include "lib/air_drag.glsl"
#include "shared/narrow_phase.h"
#include "shared/solver.h"

FLAT_KERNEL;
CCD_EFFECT;
DRAG_EFFECT;
CONTACTS_EFFECT;
UPDATES(0, uint, counts);
READS(1, BodyState, bodies);
READS(2, BodyShape, shapes);
WRITES(3, SolverBody, solver_bodies);
WRITES(4, vec4, spins); // that the momentum was last brought up to
WRITES(5, uint, shares); // of its way that it may go, and that is left by what does not move
READS(6, uint, steps);
WRITES(7, uint, parents); // of islands: every body is one to begin with
WRITES(8, FirstHits, first_hits);
layout(push_constant) uniform Push {
    vec4 gravity; // w: length of the step
    float lag;    // of speeds behind places, s
};

void main() {
    uint b = flatIndex();
    if (b >= counts[COUNT_BODIES]) return;
    BodyState state = bodies[b];
    mat3 inverse = worldInertia(ownInverseInertia(shapes[b]), state.turn);
    vec3 velocity = state.velocity.xyz, spin = state.spin.xyz;
    if (steps[STEPS_MADE] == 0u && state.offset.w != 0.0) velocity -= lag * gravity.xyz;
    if (kDrag != 0u) {
        velocity = velocityInAir(velocity, state.offset.w, shapes[b], uintBitsToFloat(kDrag), gravity.w);
        spin = spinInAir(spin, shapes[b], uintBitsToFloat(kDrag), gravity.w);
    }
    solver_bodies[b] = SolverBody(vec4(velocity, state.offset.w), vec4(spin, inverse[2][2]),
                                  vec4(inverse[0][0], inverse[0][1], inverse[0][2], inverse[1][1]), vec4(0.0, 0.0, 0.0, inverse[1][2]),
                                  vec4(0.0, 0.0, 0.0, 1.0));
    spins[b] = vec4(state.spin.xyz, 0.0);
    if (kContacts != 0u) {
        parents[b] = b;
        first_hits[b] = FirstHits(NO_HIT, NO_HIT, NO_HIT, NO_HIT);
    }
    if (kCcd == 0u) return;
    shares[2u * b] = floatBitsToUint(1.0);
    shares[2u * b + 1u] = floatBitsToUint(1.0);
    bool swift = isSwift(length(wayAhead(state.velocity.xyz, gravity)), gravity.w * length(state.spin.xyz), shapes[b]);
    if (swift && state.offset.w != 0.0) counts[COUNT_SWIFT] = 1u;
}
