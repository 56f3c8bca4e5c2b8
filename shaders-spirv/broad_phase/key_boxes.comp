// Where each box stands in the order of the tree's leaves: by class, and within a class by its center's place on a curve through
// the extent of all centers.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/box.glsl"
#include "lib/curve.glsl"
#include "lib/ordered_float.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec4, box_low);
READS(2, uvec4, box_high);
READS(3, uint, extent);
WRITES(4, uint, key_low);
WRITES(5, uint, key_high);
WRITES(6, uint, order);

uint classOf(Box box) {
    if (isAbsent(box)) return CLASS_ABSENT;
    if (isStatic(box)) return CLASS_STATIC;
    uint usual = extent[EXTENT_SIZES] / max(extent[EXTENT_MOVING], 1u);
    return sizeOf(box) > usual + LARGE_BITS ? CLASS_LARGE : CLASS_MOVING;
}

// Cells are cubes, as many of them along the longest side as there are steps.
uvec3 cellOf(vec3 center) {
    vec3 low = fromOrderedBits(~uvec3(extent[EXTENT_BELOW], extent[EXTENT_BELOW + 1], extent[EXTENT_BELOW + 2]));
    vec3 high = fromOrderedBits(uvec3(extent[EXTENT_ABOVE], extent[EXTENT_ABOVE + 1], extent[EXTENT_ABOVE + 2]));
    vec3 edges = high - low;
    float longest = max(edges.x, max(edges.y, edges.z));
    float cells = float(1u << CURVE_BITS), scale = longest > 1e-30 ? cells / longest : 0.0;
    return uvec3(clamp((center - low) * scale, vec3(0), vec3(cells - 1.0)));
}

void main() {
    uint piece = flatIndex();
    if (piece >= counts[COUNT_TREE_BOXES] || counts[STATUS_FAILED] != 0u) return;
    Box box = checkedBox(box_low[piece], box_high[piece]);
    uvec2 place = placeOnCurve(cellOf(isAbsent(box) ? vec3(0) : centerOf(box)));
    key_low[piece] = place.x;
    key_high[piece] = (classOf(box) << KEY_LOW_BITS) | place.y;
    order[piece] = piece;
}
