// Publishes how many workgroups the pairs take: one each, and a lane each.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/narrow_phase.h"

layout(local_size_x = 1) in;
layout(constant_id = FLAT_SIZE_ID) const uint flat_size = GROUP_SIZE;
READS(0, uint, counts);
WRITES(1, uint, args);
layout(push_constant) uniform Push { NarrowPhasePush push; };

void setArguments(uint at, uint groups) {
    args[at] = min(groups, 65535u);
    args[at + 1u] = (groups + 65534u) / 65535u;
    args[at + 2u] = 1u;
}

void main() {
    uint pairs = min(counts[push.count_at], push.capacity);
    setArguments(0u, pairs);
    setArguments(4u, (pairs + flat_size - 1u) / flat_size);
}
