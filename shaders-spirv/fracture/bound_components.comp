// Where each component begins in the sorted list.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, keys);
WRITES(2, uint, component_start);

void main() {
    uint k = flatIndex(), n = counts[COUNT_VALID];
    if (k >= n || counts[STATUS_FAILED] != 0u) return;
    if (k == 0u || keys[k - 1u] != keys[k]) component_start[keys[k]] = k;
    if (k + 1u == n) component_start[keys[k] + 1u] = n;
}
