// Where each fragment goes, by its own number again; nowhere where it asked for nothing.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, order);
READS(2, uvec4, sizes);
READS(3, uvec4, begins);
WRITES(4, uvec4, rooms);

void main() {
    uint r = flatIndex();
    if (r < counts[COUNT_FRAGMENTS]) rooms[order[r]] = sizes[r].x == 0u ? uvec4(NO_INDEX) : begins[r];
}
