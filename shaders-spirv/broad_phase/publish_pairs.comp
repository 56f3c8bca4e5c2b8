// Publishes what was found in the tree, where there is one, as the pairs, and how many long lists are left to be put in order.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/broad_phase.h"

layout(local_size_x = 1) in;
UPDATES(0, uint, counts);
WRITES(1, uint, args);
#include "lib/publish.glsl"

void main() {
    publishCount(COUNT_LONG_LISTS, counts[COUNT_LONG_LISTS], NO_INDEX);
    if (counts[COUNT_TREE_BOXES] == 0u) return;
    uint needed = counts[STATUS_NEEDED + COUNT_TREE_PAIRS];
    if (needed != 0u) counts[STATUS_NEEDED + COUNT_BOX_PAIRS] = needed;
    publishCount(COUNT_BOX_PAIRS, counts[COUNT_TREE_PAIRS], NO_INDEX);
}
