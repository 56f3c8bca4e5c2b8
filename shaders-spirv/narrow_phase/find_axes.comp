// The axis along which a pair of hulls touches, a workgroup a pair: over all axes by which two convex hulls can be separate,
// or over fixed ones; for pairs that move fast, the axis of the first impact in this step.
//
// The cross product of two edges is in doubt where they are all but parallel. So the best one is measured along all corners
// before it counts: whatever rounding did to it, hulls that are apart along an axis are apart, and overlap is never deeper than
// along any axis. One that does not hold what it promised is refused, and the next best is taken.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/collider.h"
#include "shared/hull.h"
#include "shared/narrow_phase.h"
#include "lib/support_directions.glsl"

#ifndef LANES
#define LANES 8u
#endif
layout(local_size_x = LANES) in;
layout(constant_id = FIXED_AXES_ID) const uint fixed_axes = 0u;

READS(0, uint, pair_count);
READS(1, uvec2, pairs);
READS(2, PieceRecord, pieces);
READS(3, BodyState, bodies);
READS(4, HullRecord, hulls);
READS(5, vec4, hull_vertices);
READS(6, HullFace, hull_faces);
READS(7, uint, hull_corners);
READS(8, uvec4, hull_edges);
WRITES(9, AxisRecord, axes);
layout(push_constant) uniform Push { NarrowPhasePush push; };

#include "lib/hull_pair.glsl"

shared vec4 corners[2 * HULL_VERTICES]; // of A and of B in the pair's frame; w: height along the axis measured last
uint lane = gl_LocalInvocationID.x;
HullPair pair;
uint corner_count[2], face_count[2], edge_count[2];

#include "lib/axis_search.glsl"
#include "lib/face_axes.glsl"
#include "lib/edge_axes.glsl"

const uint kRounds = 3u;
// Axes whose separations differ by less than this share of the smaller hull are as good: faces go before edges, A before B, so
// that the axis of hulls that rest does not change with rounding.
const float kTie = 2e-5;

bool is_fast; // faster than the margin in this step
float tie;

void loadHulls(uint k) {
    pair = loadPair(pairs[k], push.duration, push.speculative);
    is_fast = dot(pair.motion, pair.motion) > pair.margin * pair.margin;
    if (!is_fast) pair.motion = vec3(0.0);
    tie = kTie * pair.smaller + pair.rounding;
    for (uint side = 0u; side < 2u; side++) {
        corner_count[side] = min(pair.hull[side].count.x, HULL_VERTICES);
        face_count[side] = min(pair.hull[side].count.y, HULL_FACES);
        edge_count[side] = min(pair.hull[side].count.w, HULL_EDGES);
        for (uint v = lane; v < corner_count[side]; v += LANES)
            corners[side * HULL_VERTICES + v] = vec4(cornerAt(pair, side, v), 0.0);
    }
    barrier();
}

vec3 faceAxis(uint feature) {
    return (feature >> AXIS_KIND_SHIFT) == AXIS_FACE_A ? faceNormal(0u, feature & 0xffu) : -faceNormal(1u, feature & 0xffu);
}

vec3 edgeAxis(uint feature) { return axisBetween(edgeOf(0u, (feature >> 8) & 0xffu), edgeOf(1u, feature & 0xffu)); }

vec3 axisOf(uint feature) {
    uint kind = feature >> AXIS_KIND_SHIFT;
    return fixed_axes != 0u ? fixedAxis(feature & 0xffu) : kind == AXIS_EDGES ? edgeAxis(feature) : faceAxis(feature);
}

// B's best instead of A's where it is better for certain, in both respects; what either has seen counts for leaving.
Seen betterOf(Seen a, Seen b) {
    Seen both = a;
    if (b.separation > a.separation + tie) {
        both.separation = b.separation;
        both.feature = b.feature;
    }
    if (a.enter == -kFar || (b.enter - a.enter) * length(pair.motion) > tie) {
        both.enter = b.enter;
        both.enter_feature = b.enter_feature;
    }
    both.leave = min(a.leave, b.leave);
    return both;
}

bool isHit(Seen seen) { return is_fast && seen.separation > 0.0 && seen.enter >= 0.0 && seen.enter <= min(seen.leave, 1.0); }

bool isApart(Seen seen) { return seen.separation > pair.margin && !isHit(seen); }

// How far apart two points of the hulls are at most, by the way between their centers.
float gapOf(Seen a, Seen b) { return length(pair.place[1]) * max(1.0 - a.reach - b.reach, 0.0); }

// The best axis between edges, and whether it holds along all corners what it promised.
bool holds(inout Seen edges) {
    vec3 n = edgeAxis(isHit(edges) ? edges.enter_feature : edges.feature);
    vec4 heights = measureAlong(n);
    float separation = heights.z - heights.y;
    if (!isHit(edges)) {
        bool kept = separation >= edges.separation - tie;
        edges.separation = separation;
        return kept;
    }
    float speed = dot(n, pair.motion);
    float entered = speed < 0.0 ? -separation / speed : -kFar;
    bool kept = (edges.enter - entered) * length(pair.motion) <= tie;
    edges.enter = entered;
    return kept;
}

// `faces` with what edges add to it.
Seen withEdges(Seen faces, bool wanted) {
    Seen limit = seenNothing(), best = faces;
    limit.separation = kFar;
    bool open = wanted;
    for (uint attempt = 0u; attempt < kRounds && open; attempt++) {
        Seen edges = seeEdges(limit, open);
        Seen both = betterOf(faces, edges);
        bool takes_edges = isHit(both) ? both.enter_feature == edges.enter_feature : both.feature == edges.feature;
        limit = edges;
        bool kept = !takes_edges || holds(edges);
        best = kept ? betterOf(faces, edges) : best;
        open = !kept;
    }
    return best;
}

Seen searchAll() {
    Seen a = seeFaces(0u), b = seeFaces(1u);
    Seen faces = betterOf(a, b);
    vec4 heights = measureAlong(faceAxis(faces.feature));
    float depth = (is_fast ? kFar : max(-faces.separation, gapOf(a, b))) + tie;
    bool wanted = !isApart(faces);
    listNearEdges(heights.z - depth, heights.y + depth, wanted);
    return withEdges(faces, wanted);
}

void writeAxis(uint k, uint feature, vec3 shift) {
    vec3 n = axisOf(feature);
    vec4 heights = measureAlong(n);
    float low = heights.z + dot(n, shift);
    Seen face_a = facingFace(0u, n, heights.y), face_b = facingFace(1u, n, -heights.z);
    uint kind = feature >> AXIS_KIND_SHIFT;
    if (kind == AXIS_FACE_A) face_a.feature = feature & 0xffu;
    if (kind == AXIS_FACE_B) face_b.feature = feature & 0xffu;
    bool b_leads = kind == AXIS_FACE_B || (kind == AXIS_FIXED && face_b.separation > face_a.separation + kTie);
    if (lane != 0u) return;
    uvec2 faces = b_leads ? uvec2(face_b.feature, face_a.feature) : uvec2(face_a.feature, face_b.feature);
    axes[k] = AxisRecord(vec4(n, low - heights.y), vec4(shift, b_leads ? -low : heights.y), uvec4(feature, b_leads, faces));
}

void main() {
    uint k = flatGroup();
    if (k >= min(pair_count[0], push.capacity)) return;
    loadHulls(k);
    Seen seen = fixed_axes == 0u ? searchAll() : seeFixedAxes(min(fixed_axes, uint(SUPPORT_DIRECTIONS) / 2u));
    if (isApart(seen)) {
        if (lane == 0u) axes[k] = AxisRecord(vec4(0.0), vec4(0.0), uvec4(AXIS_APART));
        return;
    }
    bool is_hit = isHit(seen);
    writeAxis(k, is_hit ? seen.enter_feature : seen.feature, is_hit ? seen.enter * pair.motion : vec3(0.0));
}
