// Which of the objects that broke a fragment is a part of: its cell's site lies in that object's tile. Wants `fragments` and
// `sites` declared.
#include "lib/tile.glsl"

uint objectOfFragment(uint f) { return tileNumber(sites[fragments[f].fate.z].xyz); }

// 1 over a power of two, bit for bit, which a division need not be.
float inversePower(float power) { return uintBitsToFloat(0x7f000000u - floatBitsToUint(power)); }
