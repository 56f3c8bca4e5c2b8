// Contacts that break something are not solved in this step: what is left of the blow after its cracks are paid for is for the
// fragments. Bodies stop where they meet. The same for other contacts of two bodies whose blow was chosen, and for blows that
// have to wait.
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
READS(3, BlowRecord, blows);
READS(4, uint, chosen);
UPDATES(5, uint, touches);
UPDATES(6, uint, shares); // two of each body, as bits: of its way that it may go, and that is left by what does not move

// Whether the blow that a body takes part in is one between these two.
bool isBetween(uint body, uvec2 ids) {
    uint p = chosen[body];
    if (p == NO_INDEX) return false;
    uvec2 of = memory[p].ids.xy;
    return of == ids || of == ids.yx;
}

void hold(uint body, float share) {
    if (bodies[body].offset.w != 0.0) atomicMin(shares[2u * body], floatBitsToUint(share));
}

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_STRUCK] || touches[p] == 0u) return;
    uvec2 ids = memory[p].ids.xy;
    if (blows[p].sides.x != 0u) {
        hold(ids.x, blows[p].blow.w);
        hold(ids.y, blows[p].blow.w);
        touches[p] = 0u;
    } else if (isBetween(ids.x, ids) || isBetween(ids.y, ids)) {
        touches[p] = 0u;
    }
}
