// Whether what broke may be used. The host would look at these words and record the event again, or report them; here the
// fragments are taken back, and the objects stay whole.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(local_size_x = 1) in;
UPDATES(0, uint, counts);
WRITES(1, uint, args);
#include "lib/publish.glsl"

const uint kTroubles[] = uint[](STATUS_BAD_CELLS, STATUS_BAD_CLIP, STATUS_BAD_LOOKUP, STATUS_BAD_DEPTH, STATUS_BAD_CAP,
                                STATUS_BAD_UNION, STATUS_BAD_WELD, STATUS_ROUNDS_LEFT, STATUS_CROWDED, STATUS_TOO_LONG,
                                STATUS_BAD_DIAGRAM, STATUS_OPEN_OUTLINES);

void main() {
    uint troubles = 0u;
    for (uint k = 0u; k < uint(kTroubles.length()); k++) troubles |= counts[kTroubles[k]];
    if (troubles != 0u) atomicOr(counts[STATUS_FAILED], FAILED_CHECK);
    if (counts[STATUS_FAILED] == 0u) return;
    publishCount(COUNT_FRAGMENTS, 0u, NO_INDEX);
    publishCount(COUNT_EMITTED, 0u, NO_INDEX);
    publishCount(COUNT_COLLIDERS, 0u, NO_INDEX);
}
