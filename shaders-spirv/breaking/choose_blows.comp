// The blow that each body takes part in: of those that come first to it the hardest, if it is that of the other as well; of such that are
// equal, that of the first pair.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/breaking.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ContactMemory, memory);
READS(2, BlowRecord, blows);
READS(3, uint, hardest); // 0: takes part in any number of blows
UPDATES(4, uint, chosen);

bool isHardest(uint body, float energy) { return hardest[body] == 0u || hardest[body] == floatBitsToUint(energy); }

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_STRUCK] || blows[p].sides.z == 0u) return;
    uvec2 ids = memory[p].ids.xy;
    float energy = blows[p].blow.z;
    if (!isHardest(ids.x, energy) || !isHardest(ids.y, energy)) return;
    if (hardest[ids.x] != 0u) atomicMin(chosen[ids.x], p);
    if (hardest[ids.y] != 0u) atomicMin(chosen[ids.y], p);
}
