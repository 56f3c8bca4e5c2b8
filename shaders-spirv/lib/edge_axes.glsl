// Axes that are cross products of an edge of A and an edge of B.
//
// Two edges give a face of B - A where the arcs that they are on the Gauss sphere cross; four signs tell. The arcs of a flat hull
// are half circles, for which the same four signs hold. Only edges that lie near the other hull can do: the axis that decides
// touches both hulls at points no further apart than `depth`, so edges that end further below the top of A, or above the bottom
// of B, along any one axis, are left out. On a face that rests on another this leaves the edges around the two.
#ifndef EDGE_AXES_GLSL
#define EDGE_AXES_GLSL

#define STAGED_EDGES 64u
// Edges that are closer to parallel than this give no axis: the sliver of a face between them is thinner than what counts.
const float kParallel = 1e-4;

struct HullEdge {
    vec3 from;
    vec3 along; // unit
    vec3 left;  // normals of the faces
    vec3 right;
};

shared uint near_edges[2 * HULL_EDGES];
shared uint near_count[2];
shared vec4 staged_from[STAGED_EDGES]; // w: the edge
shared vec4 staged_along[STAGED_EDGES];
shared vec4 staged_left[STAGED_EDGES];
shared vec4 staged_right[STAGED_EDGES];

HullEdge edgeOf(uint side, uint e) {
    uvec4 edge = hull_edges[pair.hull[side].first.w + e];
    vec3 from = corners[side * HULL_VERTICES + edge.x].xyz;
    vec3 along = corners[side * HULL_VERTICES + edge.y].xyz - from;
    return HullEdge(from, along * inversesqrt(max(dot(along, along), 1e-37)), faceNormal(side, edge.z), faceNormal(side, edge.w));
}

// The axis from A to B, 0 where the two give none.
vec3 axisBetween(HullEdge a, HullEdge b) {
    float p = dot(b.along, a.left), q = dot(b.along, a.right);
    float r = dot(a.along, b.left), s = dot(a.along, b.right);
    vec3 n = cross(a.along, b.along);
    float square = dot(n, n);
    bool crossing = p * q < 0.0 && r * s < 0.0 && p * r > 0.0 && square > kParallel * kParallel;
    return crossing ? n * (p > 0.0 ? inversesqrt(square) : -inversesqrt(square)) : vec3(0.0);
}

// Lists in any order, since what is found in them does not depend on it.
void listNearEdges(float lowest_top, float highest_bottom, bool wanted) {
    if (lane < 2u) near_count[lane] = 0u;
    barrier();
    for (uint side = 0u; side < 2u; side++) {
        for (uint e = lane; e < (wanted ? edge_count[side] : 0u); e += LANES) {
            uvec4 edge = hull_edges[pair.hull[side].first.w + e];
            float x = corners[side * HULL_VERTICES + edge.x].w, y = corners[side * HULL_VERTICES + edge.y].w;
            bool near = side == 0u ? max(x, y) >= lowest_top : min(x, y) <= highest_bottom;
            if (near) near_edges[side * HULL_EDGES + atomicAdd(near_count[side], 1u)] = e;
        }
    }
    barrier();
}

void stageEdges(uint first, uint count) {
    barrier();
    for (uint k = lane; k < count; k += LANES) {
        uint e = near_edges[first + k];
        HullEdge edge = edgeOf(0u, e);
        staged_from[k] = vec4(edge.from, uintBitsToFloat(e));
        staged_along[k] = vec4(edge.along, 0.0);
        staged_left[k] = vec4(edge.left, 0.0);
        staged_right[k] = vec4(edge.right, 0.0);
    }
    barrier();
}

// One edge of B against the staged ones of A, of which those better than the limit were refused before.
void seeStaged(inout Seen seen, uint e, uint count, Seen limit) {
    HullEdge b = edgeOf(1u, e);
    for (uint k = 0u; k < count; k++) {
        HullEdge a = HullEdge(staged_from[k].xyz, staged_along[k].xyz, staged_left[k].xyz, staged_right[k].xyz);
        vec3 n = axisBetween(a, b);
        float separation = dot(n, b.from - a.from);
        uint feature = (AXIS_EDGES << AXIS_KIND_SHIFT) | (floatBitsToUint(staged_from[k].w) << 8) | e;
        bool open = isBetter(limit.separation, limit.feature, separation, feature);
        float doubt = pair.rounding * inversesqrt(max(dot(cross(a.along, b.along), cross(a.along, b.along)), 1e-12));
        if (n != vec3(0.0) && open) see(seen, separation, dot(n, pair.motion), doubt, feature);
    }
}

Seen seeEdges(Seen limit, bool wanted) {
    Seen seen = seenNothing();
    uint count_a = wanted ? near_count[0] : 0u, count_b = wanted ? near_count[1] : 0u;
    for (uint first = 0u; first < count_a; first += STAGED_EDGES) {
        uint count = min(count_a - first, STAGED_EDGES);
        stageEdges(first, count);
        for (uint j = lane; j < count_b; j += LANES) seeStaged(seen, near_edges[HULL_EDGES + j], count, limit);
    }
    return seenByAll(seen);
}

#endif
