// How many earlier islands each fragment shares its cell with: that many pairs are its own.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, island_cells); // sorted
WRITES(2, uint, pair_counts);
#define SORTED island_cells
#define SORTED_COUNT COUNT_FRAGMENTS
#include "lib/sorted_list.glsl"

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_FRAGMENTS] || counts[STATUS_FAILED] != 0u) return;
    pair_counts[k] = k - firstFrom(island_cells[k]);
}
