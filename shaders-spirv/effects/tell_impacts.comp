// The hits of a step go into a ring that the host reads when it likes; the oldest are overwritten. Of more than MOST_IMPACTS the
// hardest are told: all whose energy has a greater power of two than some, then, in the order of pairs, as many as there is room
// for of those with that one. One workgroup, which does nothing where nothing was hit.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/impact.h"
#include "shared/solver.h"
#include "lib/sector.glsl"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, uint, contact_slots);
READS(2, SolverContact, solver_contacts);
READS(3, SolverBody, solver_bodies);
READS(4, float, hits);
UPDATES(5, uint, told);
WRITES(6, ImpactEvent, ring);
READS(7, BodyState, bodies); // as they stood when the step began
READS(8, BreakableBody, breakable);
READS(9, uint, steps);
READS(10, ContactMemory, memory);
layout(push_constant) uniform Push {
    float least_speed;
    uint breaks; // 0: nothing does, and `breakable` is something else
};
#include "lib/origin.glsl"
#include "lib/impact.glsl"

#define POWERS 256 /* of two */

shared uint powers[POWERS];
shared uint flags[GROUP_SIZE];
shared uint least_power, written;

uint powerOf(float energy) { return floatBitsToUint(energy) >> 23; }

void countPowers(uint lane) {
    for (uint p = lane; p < POWERS; p += GROUP_SIZE) powers[p] = 0u;
    barrier();
    for (uint at = lane, contacts = counts[COUNT_CONTACTS]; at < contacts; at += GROUP_SIZE)
        if (hits[at] > 0.0) atomicAdd(powers[powerOf(hits[at])], 1u);
    barrier();
}

// That of which not all may be told, or the least of all.
void findLeastPower(uint lane) {
    if (lane == 0u) {
        uint sum = 0u, power = POWERS - 1u;
        for (; power > 0u && sum + powers[power] <= MOST_IMPACTS; power--) sum += powers[power];
        least_power = power;
        written = 0u;
    }
    barrier();
}

ImpactEvent eventOf(uint c) {
    uvec2 ids = solver_contacts[c].ids.xy;
    Impact impact = impactOf(c, least_speed);
    bool on_b = length(solver_bodies[ids.y].moved.xyz) < length(solver_bodies[ids.x].moved.xyz);
    uint body = on_b ? ids.y : ids.x;
    vec3 offset = bodies[body].offset.xyz + (on_b ? impact.arm_b : impact.arm_a);
    ivec3 sectors = sectorsIn(offset);
    ImpactEvent event;
    event.what = uvec4(steps[STEPS_MADE] + 1u, ids, impact.points);
    event.born = breaks != 0u ? uvec4(bornIn(ids.x), bornIn(ids.y), originOf(ids.x), originOf(ids.y)) : uvec4(0u, 0u, ids);
    event.sector = ivec4(bodies[body].sector.xyz + sectors, 0);
    event.offset = vec4(offsetWithin(offset, sectors), 0.0);
    event.along = vec4(solver_contacts[c].normal.xyz, 0.0);
    event.measures = vec4(impact.mass, impact.speed, energyOf(impact), impact.impulse);
    return event;
}

// In the order of pairs, up to MOST_IMPACTS in all.
void tellPowers(uint first, uint last, uint lane) {
    uint contacts = counts[COUNT_CONTACTS];
    for (uint begin = 0u; begin < contacts; begin += GROUP_SIZE) {
        uint at = begin + lane;
        bool chosen = at < contacts && hits[at] > 0.0 && powerOf(hits[at]) >= first && powerOf(hits[at]) <= last;
        flags[lane] = chosen ? 1u : 0u;
        barrier();
        uint before = written, all_ = written;
        for (uint k = 0u; k < GROUP_SIZE; k++) {
            before += k < lane ? flags[k] : 0u;
            all_ += flags[k];
        }
        if (chosen && before < MOST_IMPACTS) ring[(told[IMPACTS_TOLD] + before) % IMPACT_EVENTS] = eventOf(contact_slots[at]);
        barrier();
        if (lane == 0u) written = min(all_, uint(MOST_IMPACTS));
        barrier();
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x, hit = told[IMPACTS_HIT];
    barrier(); // before anybody writes it
    if (hit == 0u) return;
    bool made = counts[STATUS_FAILED] == 0u;
    if (made) {
        countPowers(lane);
        findLeastPower(lane);
        tellPowers(least_power + 1u, POWERS - 1u, lane);
        tellPowers(least_power, least_power, lane);
    }
    if (lane != 0u) return;
    told[IMPACTS_HIT] = 0u;
    if (!made) return;
    told[IMPACTS_TOLD] += written;
    told[IMPACTS_WEAK] += hit - written;
}
