// Lists the cells that the filtered kernel left undecided.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, raw);
WRITES(2, uint, queue);
layout(push_constant) uniform Push { uint slots; };

void main() {
    uint cell = flatIndex();
    if (cell < min(slots, counts[COUNT_SITES])) {
        if (raw[cell * RAW_WORDS] != CELL_OK) queue[atomicAdd(counts[COUNT_EXACT_SMALL], 1u)] = cell;
    }
}
