// What each finished cell holds: neighbors, corners, and the Voronoi vertices and edges of which it is the lowest site.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/diagram.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uvec2, cell_raw);
READS(2, uint, raw);
WRITES(3, uvec4, cell_counts);
#include "lib/raw_cell.glsl"

void main() {
    uint cell = flatIndex();
    if (cell >= counts[COUNT_SITES]) return;
    bool used = counts[STATUS_FAILED] == 0u;
    RawCell r = openCell(used ? cell : 0u);
    if (used && r.status != CELL_OK) {
        atomicAdd(counts[STATUS_BAD_CELLS], 1u);
        atomicOr(counts[STATUS_FAILED], FAILED_CELLS);
    }
    uvec4 sum = uvec4(0u);
    uint planes = used ? r.plane_count : 0u, corner_count = used ? r.corner_count : 0u;
    for (uint p = 0u; p < planes; p++) sum.x += raw[r.planes + p] < BOX_BASE ? 1u : 0u;
    for (uint t = 0u; t < corner_count; t++) {
        uvec3 s = rawCorner(r, t);
        uvec3 low = sorted3(s);
        sum.z += low.x > cell && low.z < BOX_BASE ? 1u : 0u;
        sum.w += uint(ownsEdge(cell, s.x, s.y)) + uint(ownsEdge(cell, s.y, s.z)) + uint(ownsEdge(cell, s.z, s.x));
    }
    sum.y = corner_count;
    cell_counts[cell] = sum;
}
