// The component that each fragment was made of, and its cell, by which fragments are then sorted.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/fragment_record.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec4, demand_offsets);
READS(2, FragmentRecord, records);
WRITES(3, uvec2, fragment_list); // component, cell
WRITES(4, uint, island_cells);
WRITES(5, uint, islands);

void main() {
    uint c = flatIndex();
    if (c >= counts[COUNT_COMPONENTS] || counts[STATUS_FAILED] != 0u) return;
    uint f = demand_offsets[c].x;
    if (demand_offsets[c + 1u].x == f) return;
    uint cell = records[c].fate.z;
    fragment_list[f] = uvec2(c, cell);
    island_cells[f] = cell;
    islands[f] = f;
}
