// The cell that each neighbor entry belongs to.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec4, cell_offsets);
WRITES(2, uint, face_cells);

void main() {
    uint cell = flatIndex();
    if (cell >= counts[COUNT_SITES] || counts[STATUS_FAILED] != 0u) return;
    uint last = cell_offsets[cell + 1u].x;
    for (uint k = cell_offsets[cell].x; k < last; k++) face_cells[k] = cell;
}
