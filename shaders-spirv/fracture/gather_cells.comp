// Packs the cells: neighbors, corners by site ids, and the Voronoi vertices and edges that each cell owns.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/diagram.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec2, cell_raw);
READS(2, uint, raw);
READS(3, uvec4, cell_offsets);
WRITES(4, uint, neighbors);
WRITES(5, uvec4, corners);
WRITES(6, uvec2, corner_info);
WRITES(7, uvec4, vertex_sites);
WRITES(8, uvec2, edge_ends);  // for now the corner at which the edge ends, and which of its three edges it is
WRITES(9, uint, face_cells);  // the cell that each neighbor entry belongs to
#include "lib/raw_cell.glsl"

void main() {
    uint cell = flatIndex();
    if (cell >= counts[COUNT_SITES] || counts[STATUS_FAILED] != 0u) return;
    RawCell r = openCell(cell);
    uvec4 at = cell_offsets[cell];
    for (uint p = 0u; p < r.plane_count; p++) {
        uint id = raw[r.planes + p];
        if (id < BOX_BASE) {
            neighbors[at.x] = id;
            face_cells[at.x++] = cell;
        }
    }
    for (uint t = 0u; t < r.corner_count; t++) {
        uvec3 s = rawCorner(r, t);
        uvec3 low = sorted3(s);
        bool owned = low.x > cell && low.z < BOX_BASE;
        corners[at.y] = uvec4(s, owned ? at.z : NO_INDEX);
        corner_info[at.y] = uvec2(cell, at.w);
        if (owned) vertex_sites[at.z] = uvec4(cell, low);
        if (ownsEdge(cell, s.x, s.y)) edge_ends[at.w++] = uvec2(at.y, 0u);
        if (ownsEdge(cell, s.y, s.z)) edge_ends[at.w++] = uvec2(at.y, 1u);
        if (ownsEdge(cell, s.z, s.x)) edge_ends[at.w++] = uvec2(at.y, 2u);
        at.y++;
        at.z += owned ? 1u : 0u;
    }
}
