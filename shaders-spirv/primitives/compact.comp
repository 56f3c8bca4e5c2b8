// Lists the flagged elements in their own order: where a scan of 0/1 flags steps up, the element's index goes to the step.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, offsets);
WRITES(2, uint, list);
layout(push_constant) uniform Push {
    uint length;
    uint length_count;
};

void main() {
    uint n = length_count == NO_INDEX ? length : counts[length_count];
    uint k = flatIndex();
    if (k >= n || counts[STATUS_FAILED] != 0u) return;
    uint at = offsets[k];
    if (offsets[k + 1u] != at) list[at] = k;
}
