// Which island each body is of: the lowest body of it names it.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
UPDATES(1, uint, parents);
WRITES(2, uint, islands);
#include "lib/union_find.glsl"

void main() {
    uint b = flatIndex();
    if (b < counts[COUNT_BODIES]) islands[b] = rootOf(b);
}
