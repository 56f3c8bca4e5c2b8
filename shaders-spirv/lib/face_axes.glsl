// Axes that are normals of faces, and the fixed ones; which faces lie towards an axis.
#ifndef FACE_AXES_GLSL
#define FACE_AXES_GLSL

vec3 faceNormal(uint side, uint face) {
    vec3 own = hull_faces[pair.hull[side].first.y + face].plane.xyz;
    return side == 0u ? own : pair.axes[1] * own;
}

// Of the plane above the center of its hull. Flat hulls have their center in it.
float faceHeight(uint side, uint face) {
    vec4 plane = hull_faces[pair.hull[side].first.y + face].plane;
    return plane.w - dot(plane.xyz, pair.hull[side].center.xyz);
}

float lowestAlong(vec3 n, uint side) {
    float lowest = kFar;
    for (uint v = 0u; v < corner_count[side]; v++) lowest = min(lowest, dot(n, corners[side * HULL_VERTICES + v].xyz));
    return lowest;
}

Seen seeFaces(uint side) {
    Seen seen = seenNothing();
    vec3 way = side == 0u ? pair.place[1] : -pair.place[1];
    vec3 motion = side == 0u ? pair.motion : -pair.motion;
    for (uint f = lane; f < face_count[side]; f += LANES) {
        vec3 n = faceNormal(side, f);
        float height = faceHeight(side, f);
        float separation = lowestAlong(n, 1u - side) - dot(n, pair.place[side]) - height;
        see(seen, separation, dot(n, motion), 0.0, ((side == 0u ? AXIS_FACE_A : AXIS_FACE_B) << AXIS_KIND_SHIFT) | f);
        float towards = dot(n, way);
        if (towards > 0.0) seen.reach = min(seen.reach, max(height, 0.0) / towards);
    }
    return seenByAll(seen);
}

// Pairs of opposite directions of the world: direction 2 k is the k-th of the table, 2 k + 1 its opposite.
vec3 fixedAxis(uint direction) { return turned(turnBack(pair.turn), normalize(vec3(supportDirection(direction)))); }

// The separating axis theorem over predefined axes (the paper, section 6).
Seen seeFixedAxes(uint pairs) {
    Seen seen = seenNothing();
    for (uint d = lane; d < 2u * pairs; d += LANES) {
        vec3 n = fixedAxis(d);
        float separation = lowestAlong(n, 1u) + lowestAlong(-n, 0u);
        see(seen, separation, dot(n, pair.motion), 0.0, (AXIS_FIXED << AXIS_KIND_SHIFT) | d);
    }
    return seenByAll(seen);
}

// How far a face reaches towards the other hull, by the heights measured last.
float reachOf(uint side, uint face) {
    uvec2 loop = hull_faces[pair.hull[side].first.y + face].loop.xy;
    float reach = -kFar;
    for (uint c = 0u; c < min(loop.y, HULL_FACES); c++) {
        float height = corners[side * HULL_VERTICES + hull_corners[loop.x + c]].w;
        reach = max(reach, side == 0u ? height : -height);
    }
    return reach;
}

// Of the faces that hold the furthest corner of the hull along the axis, the one that faces it most squarely: (alignment, face).
Seen facingFace(uint side, vec3 n, float furthest) {
    Seen seen = seenNothing();
    for (uint f = lane; f < face_count[side]; f += LANES) {
        float alignment = dot(faceNormal(side, f), side == 0u ? n : -n);
        if (reachOf(side, f) >= furthest - pair.rounding) see(seen, alignment, 0.0, 0.0, f);
    }
    return seenByAll(seen);
}

#endif
