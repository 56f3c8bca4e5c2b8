// How many bodies each strike reaches that it may break: its energy is shared among them.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/solver.h"
#include "shared/strike.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, BreakableBody, breakable);
READS(2, uint, steps);
READS(3, uint, claims);
UPDATES(4, uint, reached); // by strike
layout(push_constant) uniform Push { uint count; float duration; }; // of the step, s

void main() {
    uint body = flatIndex();
    if (body >= counts[COUNT_BODIES] || float(steps[STEPS_MADE]) * duration < breakable[body].form.w) return;
    for (uint k = 0u; k < min(count, uint(MOST_STRIKES)); k++)
        if (claims[body * uint(MOST_STRIKES) + k] != NO_INDEX) atomicAdd(reached[k], 1u);
}
