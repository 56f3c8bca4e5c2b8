// Contacts that bodies do not come to in this step, since a blow stops them before, are not solved: a ball that is stopped by the
// pane that it breaks would else leave its speed with the wall behind. Each of the two goes on along the normal until then.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ContactMemory, memory);
READS(2, BodyState, bodies);
READS(3, SolverBody, solver_bodies);
READS(4, uint, shares); // two of each body, as bits: the first is of its way that it may go
READS(5, BlowRecord, blows);
READS(6, uint, chosen);
UPDATES(7, uint, touches);
layout(push_constant) uniform Push {
    vec4 gravity;   // w: length of a substep, s
    float duration; // of the step, s
};
#include "lib/meeting.glsl"

const float kSooner = 1.002; // than reckoned

// Of the step, for which a body goes on: until its blow, which may lie as far behind the step's end as the solver looks ahead; or
// until it is stopped for one that has to wait.
float shareOf(uint body) {
    uint blow = chosen[body];
    float share = uintBitsToFloat(shares[2u * body]);
    if (blow != NO_INDEX) return min(uintBitsToFloat(blows[blow].sides.y), share < 1.0 ? share : 3e38);
    return share < 1.0 ? share : 1.0 + AHEAD_OF_STEP * gravity.w / duration;
}

bool isStopped(uint body) { return chosen[body] != NO_INDEX || uintBitsToFloat(shares[2u * body]) < 1.0; }

// How far it comes along `direction`, the way to the other.
float comesBy(Moving m, bool falls_, vec3 arm, vec3 direction, float share) {
    float time = share * duration, fall = falls_ ? dot(gravity.xyz, direction) : 0.0;
    return time * (dot(direction, velocityAt(m, arm)) + 0.5 * time * fall);
}

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_STRUCK] || touches[p] == 0u) return;
    uvec4 ids = memory[p].ids;
    if (!isStopped(ids.x) && !isStopped(ids.y)) return;
    float share_a = shareOf(ids.x), share_b = shareOf(ids.y);
    Pair pair = pairNow(p, ids);
    vec3 normal = memory[p].normal.xyz;
    bool is_met = false;
    for (uint k = 0u; k < MANIFOLD_POINTS && k < ids.z; k++) {
        float closed =
            comesBy(pair.a, pair.falls.x, armOfA(p, k, pair), normal, share_a) + comesBy(pair.b, pair.falls.y, armOfB(p, k, pair), -normal, share_b);
        is_met = is_met || separationNow(p, k, pair, normal) <= kSooner * max(closed, 0.0);
    }
    if (!is_met) touches[p] = 0u;
}
