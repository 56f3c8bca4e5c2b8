// Keys that the sides of vast faces are sorted by: in the order of the values, or from the beginning.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

#define KEY_FACE 0u
#define KEY_X 1u
#define KEY_Y 2u
layout(constant_id = 0) const uint kKey = KEY_FACE;
FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec4, sides); // names of both corners, any, face
READS(2, ivec4, vast_chords);
WRITES(3, uint, keys);
UPDATES(4, uint, values);

// Signed numbers in the order of unsigned ones.
uint inOrder(int x) { return uint(x) ^ 0x80000000u; }

void main() {
    uint at = flatIndex();
    if (at >= counts[COUNT_VAST_SIDES] || counts[STATUS_FAILED] != 0u) return;
    if (kKey == KEY_X) values[at] = at; // the first of the keys that corners are sorted by
    uint k = values[at];
    keys[at] = kKey == KEY_FACE ? sides[k].w : inOrder(kKey == KEY_X ? vast_chords[k].x : vast_chords[k].y);
}
