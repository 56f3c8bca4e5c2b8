// Opens the next round of a growing list: it runs over what was added since the last round began.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(local_size_x = 1) in;
UPDATES(0, uint, counts);
WRITES(1, uint, args);
UPDATES(2, uint, round_bounds); // first, end
layout(push_constant) uniform Push {
    uint capacity;
    uint is_last; // nothing may be left over when the last round has run
};
#include "lib/publish.glsl"

void main() {
    uint total = counts[COUNT_PAIRS];
    uint first = round_bounds[1];
    round_bounds[0] = first;
    round_bounds[1] = total;
    if (is_last != 0u) {
        if (total != first) atomicAdd(counts[STATUS_ROUNDS_LEFT], total - first);
        publishCount(COUNT_PAIRS, total, capacity);
    } else {
        if (total > capacity) publishCount(COUNT_PAIRS, total, capacity);
        publishCount(COUNT_ROUND, total - first, NO_INDEX);
    }
}
