// Axes that are normals of faces, and which face lies towards an axis.
#ifndef FACE_AXES_GLSL
#define FACE_AXES_GLSL

vec3 faceNormal(bool of_a, uint face) {
    vec3 own = hull_faces[(of_a ? pair.hull[0].first.y : pair.hull[1].first.y) + face].plane.xyz;
    return of_a ? own : pair.axes[1] * own;
}

// From A to B.
vec3 faceAxis(uint feature) {
    bool of_a = (feature >> AXIS_KIND_SHIFT) == AXIS_FACE_A;
    vec3 n = faceNormal(of_a, feature & 0xffu);
    return of_a ? n : -n;
}

// The lowest corner of a hull above its center along n, which is in its own axes. All lanes read the same corner at a time.
float lowestCorner(uvec2 range, vec3 center, vec3 n) {
    float lowest = kFar;
    for (uint v = 0u; v < range.y; v++) lowest = min(lowest, dot(n, hull_vertices[range.x + v].xyz - center));
    return lowest;
}

// Of a half space no axis but the way out of it counts: along any other it has no end. The hull that stands for it ends far away,
// so that an axis that is not all but this one is never the best. `axis`: from A to B.
bool leavesPlane(vec3 axis) {
    float up = pair.planes == 1u ? axis.y : -dot(axis, pair.axes[1][1]);
    return pair.planes == 0u || up > 0.5;
}

struct FaceAlong {
    vec3 axis;      // from A to B
    float towards;  // of the other hull's center along the axis
    float height;   // of the face above its own
    float separation;
};

FaceAlong alongFace(bool of_a, uint face) {
    uvec2 range = of_a ? uvec2(pair.hull[1].first.x, corner_counts.y) : uvec2(pair.hull[0].first.x, corner_counts.x);
    vec3 center = of_a ? pair.hull[0].center.xyz : pair.hull[1].center.xyz;
    vec3 other_center = of_a ? pair.hull[1].center.xyz : pair.hull[0].center.xyz;
    vec4 plane = hull_faces[(of_a ? pair.hull[0].first.y : pair.hull[1].first.y) + face].plane;
    vec3 n = of_a ? plane.xyz : pair.axes[1] * plane.xyz;
    float height = plane.w - dot(plane.xyz, center);
    float lowest = lowestCorner(range, other_center, of_a ? plane.xyz * pair.axes[1] : n);
    vec3 axis = of_a ? n : -n;
    float towards = dot(axis, pair.place[1]);
    return FaceAlong(axis, towards, height, lowest + towards - height);
}

uint featureOf(bool of_a, uint face) { return ((of_a ? AXIS_FACE_A : AXIS_FACE_B) << AXIS_KIND_SHIFT) | face; }

// Lanes without a face look at the last one again, so that all turn alike.
Seen seeFaces(bool of_a) {
    uint count = of_a ? face_counts.x : face_counts.y;
    Seen seen = seenNothing();
    for (uint base = 0u; base < count; base += LANES) {
        uint f = min(base + lane, count - 1u);
        FaceAlong along = alongFace(of_a, f);
        if (leavesPlane(along.axis)) see(seen, along.separation, dot(along.axis, pair.motion), 0.0, featureOf(of_a, f));
        if (along.towards > 0.0) seen.reach = min(seen.reach, max(along.height, 0.0) / along.towards);
    }
    return seenByAll(seen);
}

// How far a face reaches towards the other hull, by the heights measured last.
float reachOf(bool of_a, uint face) {
    HullFace at = hull_faces[(of_a ? pair.hull[0].first.y : pair.hull[1].first.y) + face];
    float reach = -kFar;
    for (uint c = 0u; c < min(at.loop.y, HULL_FACES); c++) {
        float height = corners[(of_a ? 0u : corner_counts.x) + hull_corners[at.loop.x + c]].w;
        reach = max(reach, of_a ? height : -height);
    }
    return reach;
}

// Of the faces that hold the furthest corner of the hull towards the other, the one that faces it most squarely, as a feature; its
// alignment as the separation.
Seen facingFace(bool of_a, vec3 axis, float furthest) {
    Seen seen = seenNothing();
    for (uint f = lane; f < (of_a ? face_counts.x : face_counts.y); f += LANES) {
        float alignment = dot(faceNormal(of_a, f), of_a ? axis : -axis);
        if (reachOf(of_a, f) >= furthest - pair.rounding) see(seen, alignment, 0.0, 0.0, f);
    }
    return seenByAll(seen);
}

#endif
