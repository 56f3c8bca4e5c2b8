// Where each fragment goes, by its own number again: nowhere where its object stays whole, and into dust where that breaks and it
// asked for nothing. Slots beyond all that held anything so
// far are of the world from now on.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/breaking.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, order);
READS(2, uvec4, sizes);
READS(3, uvec4, begins);
WRITES(4, uvec4, rooms);
UPDATES(5, uint, steps);
READS(6, uint, owners); // sorted
READS(7, float, cracks);

// Who was refused has begins nowhere, whatever was asked for.
uvec4 roomOf(uint r) {
    bool breaks = cracks[owners[r]] > 0.0 && begins[r].x != NO_INDEX;
    if (!breaks) return uvec4(NO_INDEX);
    return sizes[r].x == 0u ? uvec4(ROOM_OF_DUST, NO_INDEX, NO_INDEX, NO_INDEX) : begins[r];
}

void main() {
    uint r = flatIndex();
    if (r >= counts[COUNT_FRAGMENTS]) return;
    uvec4 room = roomOf(r);
    rooms[order[r]] = room;
    if (room[ROOM_BODY] >= ROOM_OF_DUST) return;
    atomicMax(steps[STEPS_BODIES], room[ROOM_BODY] + 1u);
    atomicMax(steps[STEPS_PIECES], room[ROOM_PIECE] + 1u);
}
