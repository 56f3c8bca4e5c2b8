// What the kernels that look for axes share: a workgroup a pair, its hulls loaded into one frame, and what they write.
#ifndef AXIS_KERNEL_GLSL
#define AXIS_KERNEL_GLSL
#include "shared/body.h"
#include "shared/effects.h"
#include "shared/hull.h"
#include "shared/narrow_phase.h"

#ifndef LANES
#define LANES 8u
#endif
layout(local_size_x = LANES) in;

READS(0, uint, counts);
READS(1, uvec2, pairs);
READS(2, PieceRecord, pieces);
READS(3, BodyState, bodies);
READS(4, HullRecord, hulls);
READS(5, vec4, hull_vertices);
READS(6, HullFace, hull_faces);
READS(7, uint, hull_corners);
READS(8, uvec4, hull_edges);
UPDATES(9, AxisRecord, axis_records);
UPDATES(10, FirstHits, first_hits);
layout(constant_id = SIBLINGS_ID) const uint kSiblings = 0u;
layout(push_constant) uniform Push { NarrowPhasePush push; };

#include "lib/hull_pair.glsl"

shared vec4 corners[2 * HULL_VERTICES]; // of A, then of B, in the pair's frame; w: height along the axis measured last
uint lane = gl_LocalInvocationID.x;
HullPair pair;
uvec2 corner_counts, face_counts, edge_counts; // of A and of B
bool is_fast;                                  // faster than the margin in this step
float tie;

#include "lib/axis_search.glsl"
#include "lib/note_hit.glsl"
#include "lib/face_axes.glsl"

// Axes whose separations differ by less than this share of the smaller hull are as good: faces go before edges, A before B, so
// that the axis of hulls that rest does not change with rounding.
const float kTie = 2e-5;

void loadHulls(uint k) {
    pair = loadPair(pairs[k], push);
    is_fast = isFast(pair);
    if (!is_fast) pair.motion = vec3(0.0);
    tie = kTie * pair.smaller + pair.rounding;
    corner_counts = min(uvec2(pair.hull[0].count.x, pair.hull[1].count.x), uvec2(HULL_VERTICES));
    face_counts = min(uvec2(pair.hull[0].count.y, pair.hull[1].count.y), uvec2(HULL_FACES));
    edge_counts = min(uvec2(pair.hull[0].count.w, pair.hull[1].count.w), uvec2(HULL_EDGES));
    for (uint v = lane; v < corner_counts.x + corner_counts.y; v += LANES) {
        bool of_a = v < corner_counts.x;
        corners[v] = vec4(cornerAt(pair, of_a, of_a ? v : v - corner_counts.x), 0.0);
    }
    barrier();
}

// By separate_siblings.
bool isKnown(uint k) { return kSiblings != 0u && axis_records[k].info.x != AXIS_UNKNOWN; }

bool isHit(Seen seen) { return is_fast && seen.separation > 0.0 && seen.enter >= 0.0 && seen.enter <= min(seen.leave, 1.0); }

bool isApart(Seen seen) { return seen.separation > pair.margin + pair.reach && !isHit(seen); }

// Hulls that pass each other by, though they would meet if their sides went on: a body that flies past an edge comes closer to the plane
// of a face of it, which ends before. They have no points, or they would bump into the air. Of hulls that turn by more than so many
// rad that is not known.
const float kHardlyTurns = 2e-3;

bool isMiss(Seen seen, vec3 axis) {
    bool is_known = is_fast && pair.turned_by <= kHardlyTurns && seen.separation > tie;
    return is_known && !isHit(seen) && seen.separation + dot(axis, pair.motion) < 0.0;
}

// B's best instead of A's where its separation is larger by more than `wider`, and where it is later for certain; what either has
// seen counts for leaving.
Seen betterOf(Seen a, Seen b, float wider) {
    bool is_wider = b.separation > a.separation + wider;
    bool is_later = a.enter == -kFar || (b.enter - a.enter) * length(pair.motion) > tie;
    return Seen(is_wider ? b.separation : a.separation, is_wider ? b.feature : a.feature, is_later ? b.enter : a.enter,
                is_later ? b.enter_feature : a.enter_feature, min(a.leave, b.leave), kFar);
}

// By one lane.
void keepRecord(uint k, AxisRecord record) {
    axis_records[k] = record;
    noteHit(record);
}

AxisRecord apartBy(float gap) { return AxisRecord(vec4(vec3(0.0), gap), vec4(0.0), uvec4(AXIS_APART)); }

// `heights`: as measured along the axis; `faces`: the reference face and the other one.
AxisRecord recordOf(uint feature, vec3 axis, vec4 heights, vec3 shift, bool b_leads, uvec2 faces) {
    float low = heights.z + dot(axis, shift);
    return AxisRecord(vec4(axis, low - heights.y), vec4(shift, b_leads ? -low : heights.y), uvec4(feature, b_leads, faces));
}

#endif
