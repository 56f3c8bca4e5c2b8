// Empties the lists that decide_fates fills, before it is asked again.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(local_size_x = 1) in;
UPDATES(0, uint, counts);

void main() {
    counts[COUNT_FILMS] = 0u;
    counts[COUNT_CAVITIES] = 0u;
}
