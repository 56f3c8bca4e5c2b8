// A step begins: how many pieces and bodies it has. Where all have slept for two steps, so that both memories of contacts are
// the same, it has none, and all that follows is dispatched with no workgroups.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/solver.h"

layout(local_size_x = 1) in;
UPDATES(0, uint, counts);
WRITES(1, uint, args);
UPDATES(2, uint, steps);
#include "lib/publish.glsl"

void main() {
    bool idle = steps[STEPS_ASLEEP] >= IDLE_STEPS;
    if (idle && counts[STATUS_FAILED] == 0u) steps[STEPS_MADE]++;
    publishCount(COUNT_BOXES, idle ? 0u : steps[STEPS_PIECES], NO_INDEX);
    publishCount(COUNT_BODIES, idle ? 0u : steps[STEPS_BODIES], NO_INDEX);
    publishCount(COUNT_ONCE, idle ? 0u : 1u, NO_INDEX);
}
