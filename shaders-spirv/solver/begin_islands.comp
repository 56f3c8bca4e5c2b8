// Islands begin: every body is one.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
WRITES(1, uint, parents);
WRITES(2, uint, rests); // of an island, by its lowest body: the shortest rest of its bodies, s, as bits

const uint kForever = 0x7f7fffffu;

void main() {
    uint b = flatIndex();
    if (b >= counts[COUNT_BODIES]) return;
    parents[b] = b;
    rests[b] = kForever;
}
