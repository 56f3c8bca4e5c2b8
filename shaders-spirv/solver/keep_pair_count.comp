// How many pairs the memory of this step holds. Not written in a step that nothing comes of: the memory is then still that of the
// step before the last, which the next one made goes on from.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/broad_phase.h"

layout(local_size_x = 1) in;
READS(0, uint, counts);
WRITES(1, uint, pair_count);

void main() {
    if (counts[STATUS_FAILED] == 0u) pair_count[0] = counts[COUNT_BOX_PAIRS];
}
