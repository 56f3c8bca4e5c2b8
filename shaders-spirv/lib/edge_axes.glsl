// Axes that are cross products of an edge of A and an edge of B.
//
// Two edges give a face of B - A where the arcs that they are on the Gauss sphere cross; four signs tell. The arcs of a flat hull
// are half circles, for which the same four signs hold. Only edges that lie near the other hull can do. The axis that decides
// touches both hulls at points no further apart than the smallest depth or gap known. Hulls that meet in this step touch at points
// no further apart, along any one axis, than they come closer along it. Edges that end further than that below the top of A, or
// above the bottom of B, are left out. On a face that rests on another this leaves the edges around the two.
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
shared vec4 shared_axis;

// Directions from the hull's own corners: between corners in the pair's frame, short edges far from its origin would have none.
HullEdge edgeOf(bool of_a, uint e) {
    uvec4 edge = hull_edges[(of_a ? pair.hull[0].first.w : pair.hull[1].first.w) + e];
    uint first = of_a ? pair.hull[0].first.x : pair.hull[1].first.x;
    vec3 from = corners[(of_a ? 0u : corner_counts.x) + edge.x].xyz;
    vec3 along = hull_vertices[first + edge.y].xyz - hull_vertices[first + edge.x].xyz;
    along *= inversesqrt(max(dot(along, along), 1e-37));
    along = of_a ? along : pair.axes[1] * along;
    return HullEdge(from, along, faceNormal(of_a, edge.z), faceNormal(of_a, edge.w));
}

// The axis from A to B; w: sine between the edges, 0 where the two give none.
vec4 axisBetween(HullEdge a, HullEdge b) {
    float p = dot(b.along, a.left), q = dot(b.along, a.right);
    float r = dot(a.along, b.left), s = dot(a.along, b.right);
    vec3 n = cross(a.along, b.along);
    float square = dot(n, n), over = inversesqrt(max(square, 1e-20));
    bool crossing = p * q < 0.0 && r * s < 0.0 && p * r > 0.0 && square > kParallel * kParallel;
    return vec4(n * (p > 0.0 ? over : -over), crossing ? square * over : 0.0);
}

// A barrier before the next are listed.
void forgetNearEdges() {
    if (lane < 2u) near_count[lane] = 0u;
}

// Lists in any order, since what is found in them does not depend on it.
void listNearEdges(float lowest_top, float highest_bottom, bool wanted) {
    for (uint k = lane; k < (wanted ? edge_counts.x + edge_counts.y : 0u); k += LANES) {
        bool of_a = k < edge_counts.x;
        uint e = of_a ? k : k - edge_counts.x, side = of_a ? 0u : 1u;
        uvec2 edge = hull_edges[(of_a ? pair.hull[0].first.w : pair.hull[1].first.w) + e].xy + (of_a ? 0u : corner_counts.x);
        float x = corners[edge.x].w, y = corners[edge.y].w;
        bool near = of_a ? max(x, y) >= lowest_top : min(x, y) <= highest_bottom;
        if (near) near_edges[side * HULL_EDGES + atomicAdd(near_count[side], 1u)] = e;
    }
    barrier();
}

void stageEdges(uint first, uint count) {
    barrier();
    for (uint k = lane; k < count; k += LANES) {
        uint e = near_edges[first + k];
        HullEdge edge = edgeOf(true, e);
        staged_from[k] = vec4(edge.from, uintBitsToFloat(e));
        staged_along[k] = vec4(edge.along, 0.0);
        staged_left[k] = vec4(edge.left, 0.0);
        staged_right[k] = vec4(edge.right, 0.0);
    }
    barrier();
}

struct SeenAxes {
    vec3 best;
    vec3 entered;
};

// One edge of B against the staged ones of A, of which those better than the limit were refused before.
void seeStaged(inout Seen seen, inout SeenAxes axes, uint e, uint count, Seen limit) {
    HullEdge b = edgeOf(false, e);
    float doubt = pair.rounding + kRounding * length(pair.place[1]); // times what the angle between the edges makes of it
    for (uint k = 0u; k < count; k++) {
        vec4 from = staged_from[k];
        vec4 n = axisBetween(HullEdge(from.xyz, staged_along[k].xyz, staged_left[k].xyz, staged_right[k].xyz), b);
        float separation = dot(n.xyz, b.from - from.xyz);
        uint feature = (AXIS_EDGES << AXIS_KIND_SHIFT) | (floatBitsToUint(from.w) << 8) | e;
        bool is_open = n.w > 0.0 && isBetter(limit.separation, limit.feature, separation, feature);
        bvec2 won = bvec2(false);
        if (is_open) won = see(seen, separation, dot(n.xyz, pair.motion), doubt / max(n.w, kParallel), feature);
        axes.best = won.x ? n.xyz : axes.best;
        axes.entered = won.y ? n.xyz : axes.entered;
    }
}

// The axis of what all have seen, from the lane that saw it.
vec3 sharedAxis(Seen mine, SeenAxes axes, Seen all, bool by_time) {
    bool is_mine = by_time ? mine.enter_feature == all.enter_feature : mine.feature == all.feature;
    if (is_mine) shared_axis = vec4(by_time ? axes.entered : axes.best, 0.0);
    barrier();
    return shared_axis.xyz;
}

#endif
