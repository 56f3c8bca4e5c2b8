// Sides of clipped polygons that lie in a bisector bound its cap, the other way round. A polygon that lies in the bisector
// itself, with the solid on the other side, goes over to that side, and takes its outline out of the cap.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(constant_id = 0) const uint kFill = 0u;
FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uvec4, cell_offsets);
READS(2, uint, neighbors);
READS(3, uvec4, polygons);
READS(4, uvec4, polygon_offsets);
READS(5, uint, sides);
READS(6, uint, polygon_corners);
UPDATES(7, uint, face_counts);
READS(8, uint, face_offsets);
WRITES(9, uvec4, segments);

uint faceOf(uint i, uint j) {
    uint found = NO_INDEX, last = cell_offsets[i + 1u].x;
    for (uint k = cell_offsets[i].x; k < last; k++) found = neighbors[k] == j ? k : found;
    return found;
}

// `flat_`: 1 of what is taken out of the cap, 0 of its boundary.
void addSegment(uint face, uint a, uint b, uint source, uint flat_) {
    if (face == NO_INDEX) {
        atomicAdd(counts[STATUS_BAD_LOOKUP], 1u);
        return;
    }
    uint at = atomicAdd(face_counts[face], 1u);
    if (kFill != 0u) segments[face_offsets[face] + at] = uvec4(a, b, source, flat_);
}

void main() {
    uint q = flatIndex();
    if (q >= counts[COUNT_POLYGONS] || counts[STATUS_FAILED] != 0u) return;
    uvec4 polygon = polygons[q], at = polygon_offsets[q];
    uint n = polygon_offsets[q + 1u].x - at.x, cell = polygon.y, with = polygon.z;
    uint source = 3u * counts[COUNT_INTERVALS] + at.z;
    uint flat_face = with != NO_INDEX ? faceOf(min(cell, with), max(cell, with)) : NO_INDEX;
    uint start = polygon_corners[at.x + n - 1u];
    for (uint k = 0u; k < n; k++) {
        uint j = sides[at.x + k], end = polygon_corners[at.x + k];
        if (j < EDGE_BASE && j > cell) addSegment(faceOf(cell, j), end, start, source++, 0u);
        if (with != NO_INDEX) {
            bool lower = with < cell;
            addSegment(flat_face, lower ? end : start, lower ? start : end, source++, 1u);
        }
        start = end;
    }
}
