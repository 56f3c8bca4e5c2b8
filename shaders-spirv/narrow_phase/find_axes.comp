// The axis along which a pair of hulls touches, a workgroup a pair: over all axes by which two convex hulls can be separate; for
// pairs that move fast, the axis of the first impact in this step.
//
// The cross product of two edges is in doubt where they are all but parallel. So the best one is measured along all corners
// before it counts: whatever rounding did to it, hulls that are apart along an axis are apart, and overlap is never deeper than
// along any axis. One that does not hold what it promised is refused, and the next best is taken.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/axis_kernel.glsl"
#include "lib/edge_axes.glsl"
#include "lib/graze.glsl"
#include "lib/hidden_side.glsl"
#include "shared/sweep.h"

const uint kAttempts = 3u;

vec3 edge_axis;

// How far apart two points of the hulls are at most, by the way between their centers.
float gapOf(Seen a, Seen b) { return length(pair.place[1]) * max(1.0 - a.reach - b.reach, 0.0); }

Seen seeEdges(Seen limit, bool wanted) {
    Seen seen = seenNothing();
    SeenAxes axes = SeenAxes(vec3(0.0), vec3(0.0));
    uint count_a = wanted ? near_count[0] : 0u, count_b = wanted ? near_count[1] : 0u;
    for (uint first = 0u; first < count_a; first += STAGED_EDGES) {
        uint count = min(count_a - first, STAGED_EDGES);
        stageEdges(first, count);
        for (uint j = lane; j < count_b; j += LANES) seeStaged(seen, axes, near_edges[HULL_EDGES + j], count, limit);
    }
    Seen all = seenByAll(seen);
    edge_axis = sharedAxis(seen, axes, all, isHit(all));
    return all;
}

// The best axis between edges as it is along all corners, and whether it holds what it promised.
bool holds(inout Seen edges) {
    bool is_hit = isHit(edges);
    vec4 heights = measureAlong(edge_axis);
    float separation = heights.z - heights.y, speed = dot(edge_axis, pair.motion);
    float entered = speed < 0.0 ? -separation / speed : -kFar;
    bool kept = is_hit ? (edges.enter - entered) * length(pair.motion) <= tie : separation >= edges.separation - tie;
    if (is_hit) edges.enter = entered;
    else edges.separation = separation;
    return kept;
}

// `faces` with what edges add to it.
Seen withEdges(Seen faces, bool wanted) {
    Seen limit = seenNothing(), best = faces;
    limit.separation = kFar;
    bool open = wanted;
    for (uint attempt = 0u; attempt < ROLLED(kAttempts) && open; attempt++) {
        Seen edges = seeEdges(limit, open);
        limit = edges;
        float lead = leadOver(faceAxis(faces.feature), edge_axis);
        Seen both = betterOf(faces, edges, lead);
        bool takes_edges = isHit(both) ? both.enter_feature == edges.enter_feature : both.feature == edges.feature;
        bool kept = holds(edges) || !takes_edges;
        if (kept) best = takes_edges ? betterOf(faces, edges, lead) : both;
        open = !kept;
    }
    return best;
}

Seen searchAll() {
    Seen a, b;
    forgetNearEdges();
    for (uint side = 0u; side < ROLLED(2); side++) {
        Seen seen = seeFaces(side == 0u);
        if (side == 0u) a = seen;
        else b = seen;
    }
    float lead = leadOver(faceAxis(a.feature), faceAxis(b.feature));
    Seen faces = betterOf(a, b, floor_side == 2u && lead > tie ? -lead : lead);
    vec3 axis = faceAxis(faces.feature);
    vec4 heights = measureAlong(axis);
    float depth = max(max(-faces.separation, gapOf(a, b)), -dot(axis, pair.motion)) + tie;
    bool wanted = !isApart(faces) && pair.planes == 0u;
    listNearEdges(heights.z - depth, heights.y + depth, wanted);
    return withEdges(faces, wanted);
}

vec3 axisOf(uint feature) { return feature >> AXIS_KIND_SHIFT == AXIS_EDGES ? edge_axis : faceAxis(feature); }

AxisRecord foundBy(uint feature, vec3 shift) {
    vec3 axis = axisOf(feature);
    vec4 heights = measureAlong(axis);
    bool b_leads = feature >> AXIS_KIND_SHIFT == AXIS_FACE_B;
    Seen facing = facingFace(b_leads, axis, b_leads ? heights.y : -heights.z);
    return recordOf(feature, axis, heights, shift, b_leads, uvec2(feature & 0xffu, facing.feature));
}

void main() {
    uint k = flatGroup();
    if (k >= min(counts[push.count_at], push.capacity) || isKnown(k)) return;
    loadHulls(k);
    findFloor();
    Seen seen = searchAll();
    bool is_hit = isHit(seen), is_apart = isApart(seen);
    uint feature = is_hit ? seen.enter_feature : seen.feature;
    vec3 shift = is_hit ? seen.enter * pair.motion : vec3(0.0);
    uint level = is_apart ? NO_INDEX : levelFace(axisOf(feature));
    if (level != NO_INDEX) {
        feature = level;
        shift = wayToFace(level);
    }
    float steps = is_hit ? seen.enter * float(SWEEP_AHEAD) : 0.0;
    uint grazed = grazedFace(axisOf(feature), steps, !is_apart);
    bool grazes = grazed != NO_INDEX;
    AxisRecord record = apartBy(seen.separation);
    if (!is_apart) record = foundBy(grazes ? grazed | AXIS_GRAZES : feature, grazes ? vec3(0.0) : shift);
    if (!grazes && isMiss(seen, record.axis.xyz)) record = apartBy(seen.separation);
    if (lane == 0u) keepRecord(k, record);
}
