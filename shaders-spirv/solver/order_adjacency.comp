// The contacts of each body in their own order, by where they are solved: sums over them come out the same, whoever listed them.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/solver.h"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, contact_pairs);
READS(2, ContactMemory, memory);
READS(3, SolverBody, solver_bodies);
READS(4, uint, adjacency_start);
READS(5, uint, loose_adjacency);
READS(6, uint, contact_slots);
WRITES(7, uint, adjacency);
#define LOOSE loose_adjacency
#include "lib/rank.glsl"

void order(uint body, uint c, uint side) {
    if (solver_bodies[body].velocity.w == 0.0) return;
    uint first = adjacency_start[body];
    adjacency[first + rankIn(first, adjacency_start[body + 1u], (c << 1) | side)] = (contact_slots[c] << 1) | side;
}

void main() {
    uint c = flatIndex();
    if (c >= counts[COUNT_CONTACTS]) return;
    uvec4 ids = memory[contact_pairs[c]].ids;
    order(ids.x, c, 0u);
    order(ids.y, c, 1u);
}
