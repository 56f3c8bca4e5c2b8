// How many contacts each body that moves has.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, contact_pairs);
READS(2, ContactMemory, memory);
READS(3, SolverBody, solver_bodies);
UPDATES(4, uint, adjacency_counts);

void main() {
    uint c = flatIndex();
    if (c >= counts[COUNT_CONTACTS]) return;
    uvec4 ids = memory[contact_pairs[c]].ids;
    if (solver_bodies[ids.x].velocity.w != 0.0) atomicAdd(adjacency_counts[ids.x], 1u);
    if (solver_bodies[ids.y].velocity.w != 0.0) atomicAdd(adjacency_counts[ids.y], 1u);
}
