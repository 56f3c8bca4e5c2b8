// Cracks are paid for by the motion of the two bodies that met, once it is known how much crack there is: an impulse at the
// contact, along its normal, that takes exactly what they cost, and no more than the two have there. It is measured from how
// they move now that the step is over. Where both break, one lane pays for both. A body that does not become its fragments after
// all stays whole, pays nothing, and is left alone for a while, so that what hit it is solved as any contact.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/material.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
UPDATES(1, BrokenBody, broken);
READS(2, float, cracks);
READS(3, uvec4, lacking);
UPDATES(4, BodyState, bodies);
READS(5, BodyShape, shapes);
UPDATES(6, BreakableBody, breakable);
READS(7, MaterialCard, cards);
READS(8, uint, steps);
UPDATES(9, CrackLedger, ledger);
layout(push_constant) uniform Push {
    float duration; // of a step
    float pause;    // s, in which what could not be broken is left alone
};
#include "lib/blow_now.glsl"

// 0 where it becomes its fragments.
uint whyWhole(uint k) {
    if (counts[STATUS_FAILED] != 0u || counts[COUNT_FRAGMENTS] == 0u) return uint(WHOLE_FAILED);
    if (cracks[k] <= 0.0) return uint(cracks[k] < 0.0 ? WHOLE_TOO_DEAR : WHOLE_ONE_PIECE);
    return lacking[k] == uvec4(0u) ? 0u : uint(WHOLE_NO_ROOM);
}

bool isServed(uint k) { return whyWhole(k) == 0u; }

float costOf(uint k) { return cards[breakable[broken[k].ids.x].surface.w].cracks.y * cracks[k]; }

float energyOfMotion(Mover m) {
    if (m.inverse_mass == 0.0) return 0.0;
    vec3 v = bodies[m.body].velocity.xyz;
    return 0.5 * (dot(v, v) / m.inverse_mass + dot(bodies[m.body].spin.xyz, bodies[m.body].momentum.xyz));
}

void push(Mover m, vec3 impulse) {
    if (m.inverse_mass == 0.0) return;
    bodies[m.body].velocity.xyz += m.inverse_mass * impulse;
    vec3 momentum = bodies[m.body].momentum.xyz + cross(m.arm, impulse);
    bodies[m.body].momentum.xyz = momentum;
    bodies[m.body].spin.xyz = spinOf(ownInverseInertia(shapes[m.body]), bodies[m.body].turn, momentum);
}

// What is struck by hand is paid for by the hand.
void payByHand(uint k, float joules) {
    float energy = energyOfMotion(moverOf(broken[k].ids.x, vec3(0.0)));
    ledger[k].energies = vec4(energy, energy, joules, cracks[k]);
}

void pay(uint k, float joules) {
    uvec2 ids = broken[k].ids.xy;
    if (ids.y == NO_INDEX) {
        payByHand(k, joules);
        return;
    }
    vec3 n = broken[k].along.xyz;
    Mover own = struckBy(k), other = striking(k);
    float before = energyOfMotion(own) + energyOfMotion(other), impulse = crackImpulse(blowNow(own, other, n), joules);
    push(own, -impulse * n);
    push(other, impulse * n);
    broken[k].blow.w = impulse;
    ledger[k].energies = vec4(before, energyOfMotion(own) + energyOfMotion(other), joules, cracks[k]);
}

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_BREAKING]) return;
    uint why = whyWhole(k);
    uint partner = partnerOf(k);
    bool both = partner != NO_INDEX && isServed(partner), is_paid_for = both && partner < k;
    ledger[k] = CrackLedger(uvec4(why, is_paid_for ? 1u : 0u, 0u, 0u), vec4(0.0, 0.0, 0.0, why == 0u ? cracks[k] : 0.0));
    if (why != 0u) {
        breakable[broken[k].ids.x].form.w = float(steps[STEPS_MADE]) * duration + pause;
        return;
    }
    if (!is_paid_for) pay(k, costOf(k) + (both ? costOf(partner) : 0.0));
}
