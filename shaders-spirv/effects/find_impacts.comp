// Which contacts were hit in this step, and with what energy. Those that break something are not solved, and are told as breaks.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/impact.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, contact_slots);
READS(2, SolverContact, solver_contacts);
READS(3, SolverBody, solver_bodies);
WRITES(4, float, hits); // J, 0 for none
UPDATES(5, uint, told);
READS(6, ContactMemory, memory);
layout(push_constant) uniform Push { float least_speed; };
#include "lib/impact.glsl"

void main() {
    uint at = flatIndex();
    if (at >= counts[COUNT_CONTACTS]) return;
    float energy = energyOf(impactOf(contact_slots[at], least_speed));
    hits[at] = energy;
    if (energy > 0.0) atomicAdd(told[IMPACTS_HIT], 1u);
}
