// Which pairs each fragment has to look through for those that are its own: all of its cell's. A fragment that has its cell for
// itself is told so.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, island_cells); // sorted
READS(2, uint, islands);
READS(3, uint, pair_offsets);
READS(4, uint, pair_slots);
WRITES(5, uvec2, parting_ranges); // by fragment: first one, how many; NO_INDEX where it is alone
#define SORTED island_cells
#define SORTED_COUNT COUNT_FRAGMENTS
#include "lib/sorted_list.glsl"

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_FRAGMENTS] || counts[STATUS_FAILED] != 0u) return;
    uint cell = island_cells[k], pairs = counts[COUNT_ISLAND_PAIRS];
    uint first = pair_offsets[firstFrom(cell)], last = pair_offsets[firstFrom(cell + 1u)];
    bool is_alone = first == last;
    uint from = is_alone ? 0u : pair_slots[min(first, pairs)], until = is_alone ? 0u : pair_slots[min(last, pairs)];
    parting_ranges[islands[k]] = is_alone ? uvec2(NO_INDEX, 0u) : uvec2(from, until - from);
}
