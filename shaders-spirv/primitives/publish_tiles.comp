// Publishes the length of a radix histogram: digits times tiles of the list to be sorted.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(local_size_x = 1) in;
UPDATES(0, uint, counts);
WRITES(1, uint, args);
layout(push_constant) uniform Push { uint length_count; };
#include "lib/publish.glsl"

void main() {
    uint tiles = (counts[length_count] + RADIX_TILE - 1u) / RADIX_TILE;
    publishCount(COUNT_RADIX, tiles << RADIX_BITS, NO_INDEX);
}
