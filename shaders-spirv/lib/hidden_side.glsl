// Hidden sides of triangles. A triangle of a mesh has no thickness, so any axis but its normal leads to a side or a corner of it. Where
// neighbors go on level there, nothing can come from that direction: the normal counts instead.
//
// Source: active edges (Terdiman, MeshContacts; Jolt's ActiveEdges.h).
//
// Wants lib/axis_kernel.glsl.
#ifndef HIDDEN_SIDE_GLSL
#define HIDDEN_SIDE_GLSL

bool isTriangle(uint side) { return pair.hull[side].count.x == 3u && pair.hull[side].count.y == 2u; }

// Sides are named by the vertex that they do not end in. `axis`: outward from the triangle.
bool leadsToHidden(uint side, vec3 axis) {
    uint hidden = hull_faces[pair.hull[side].first.y].loop.z, first = side == 0u ? 0u : corner_counts.x;
    vec3 heights = vec3(dot(axis, corners[first].xyz), dot(axis, corners[first + 1u].xyz), dot(axis, corners[first + 2u].xyz));
    float top = max(max(heights.x, heights.y), heights.z) - tie;
    // A side that ends in no corner but the highest ones; around a single corner two sides.
    uint below = (heights.x < top ? 1u : 0u) | (heights.y < top ? 2u : 0u) | (heights.z < top ? 4u : 0u);
    return below != 0u && (hidden & below) == below;
}

// The face of a triangle that looks towards the other hull.
uint faceTowards(uint side) {
    vec3 normal = faceNormal(side == 0u, 0u), other = side == 0u ? pair.place[1] : -pair.place[1];
    vec3 corner = corners[side == 0u ? 0u : corner_counts.x].xyz - pair.place[side];
    return dot(normal, other - corner) >= 0.0 ? 0u : 1u;
}

// The face that counts instead of the axis; NO_INDEX for none. `axis`: from A to B.
uint levelFace(vec3 axis) {
    for (uint side = 0u; side < ROLLED(2); side++) {
        vec3 outward = side == 0u ? axis : -axis;
        if (isTriangle(side) && leadsToHidden(side, outward)) return featureOf(side == 0u, faceTowards(side)) | AXIS_LEVEL;
    }
    return NO_INDEX;
}

// By how much B moves until the hulls meet along the axis of a face; not at all if they overlap along it, or do not meet in this step.
vec3 wayToFace(uint face) {
    FaceAlong along = alongFace(face >> AXIS_KIND_SHIFT == AXIS_FACE_A, face & 0xffu);
    float closes = -dot(along.axis, pair.motion);
    return along.separation > 0.0 && along.separation < closes ? along.separation / closes * pair.motion : vec3(0.0);
}

#endif
