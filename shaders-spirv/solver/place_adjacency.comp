// Lists the contacts of each body, in any order.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, contact_pairs);
READS(2, ContactMemory, memory);
READS(3, SolverBody, solver_bodies);
READS(4, uint, adjacency_start);
UPDATES(5, uint, adjacency_cursors);
WRITES(6, uint, loose_adjacency); // a contact's place in the list << 1, | 1 where the body is its B

void place(uint body, uint entry) {
    if (solver_bodies[body].velocity.w != 0.0)
        loose_adjacency[adjacency_start[body] + atomicAdd(adjacency_cursors[body], 1u)] = entry;
}

void main() {
    uint c = flatIndex();
    if (c >= counts[COUNT_CONTACTS]) return;
    uvec4 ids = memory[contact_pairs[c]].ids;
    place(ids.x, c << 1);
    place(ids.y, (c << 1) | 1u);
}
