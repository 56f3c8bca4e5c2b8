// Two hulls in one frame: the axes of A's body, from the center of A's hull. Everything is relative, so a pair far from the
// origin of the world gives the same bits as the same pair at it, and sizes far apart cost no digits.
// Wants `pieces`, `bodies`, `hulls` and `hull_vertices` declared.
#ifndef HULL_PAIR_GLSL
#define HULL_PAIR_GLSL
#include "lib/quaternion.glsl"
#include "shared/body.h"
#include "shared/narrow_phase.h"

struct HullPair {
    HullRecord hull[2];
    uvec4 ids;       // pieces, bodies
    uint planes;     // 1: A is one, 2: B
    mat3 axes[2];    // own axes to the frame's
    vec3 place[2];   // of the hull's center
    vec4 turn;       // the frame's axes to the world's
    vec3 motion;     // of B relative to A over the step, as far as it is swept
    vec3 drift;      // of B relative to A in a step, before anything falls
    vec3 turning[2]; // rad, of both over the step, where that moves points by more than the margin
    float turned_by; // rad, by both together, wherever that moves points
    float smaller;   // of the two radii
    float rounding;  // what heights in this frame may be off by
    float margin;    // points with this separation still count
    float reach;     // by how much any point may come closer, at most, where they turn
    float plane_reach; // to each side, of the hull that stands for a plane
};

const float kRounding = 2e-6; // of lengths, after a few products and sums
// Of the other hull's size and depth. To hold it however it turns, 2 would do; the wider, the less rounding tilts what lies on it (a
// house of cards creeps by 25 um at 4, 12 at 64, less than 10 here). Beyond 335 far corners round, by 2^-24 of their distance, by
// more than what counts as a tie (kTie): the face that is the lowest would no longer be told from others.
const float kPlaneShare = 256.0;

void loadPlaces(inout HullPair pair, float duration, vec3 gravity) {
    BodyState a = bodies[pair.ids.z], b = bodies[pair.ids.w];
    pair.turn = a.turn;
    vec4 back = turnBack(a.turn);
    pair.axes[0] = mat3(1.0);
    pair.axes[1] = matrixOf(turnAfter(back, b.turn));
    vec3 apart = vec3(b.sector.xyz - a.sector.xyz) * float(SECTOR_EDGE) + (b.offset.xyz - a.offset.xyz);
    pair.place[0] = vec3(0.0);
    pair.place[1] = turned(back, apart) + pair.axes[1] * pair.hull[1].center.xyz - pair.hull[0].center.xyz;
    // A plane has no middle: it begins below the other hull, as it would anywhere else.
    vec3 up = (pair.planes & 2u) != 0u ? pair.axes[1][1] : vec3(0.0, 1.0, 0.0);
    if (pair.planes != 0u) pair.place[1] = dot(up, pair.place[1]) * up;
    vec3 falling = gravity * ((b.offset.w > 0.0 ? 1.0 : 0.0) - (a.offset.w > 0.0 ? 1.0 : 0.0));
    pair.drift = turned(back, b.velocity.xyz - a.velocity.xyz);
    pair.motion = pair.drift + duration * turned(back, falling);
    pair.turning[0] = turned(back, duration * a.spin.xyz);
    pair.turning[1] = turned(back, duration * b.spin.xyz);
}

// What stands for a plane is no wider than the other hull calls for: far corners would round by more than a chip is thick.
void boundPlane(inout HullPair pair) {
    bool is_a = pair.planes == 1u;
    vec3 up = is_a ? vec3(0.0, 1.0, 0.0) : pair.axes[1][1];
    float above = (is_a ? pair.hull[0].center.y : pair.hull[1].center.y) + (is_a ? 1.0 : -1.0) * dot(up, pair.place[1]);
    float radius = is_a ? pair.hull[1].center.w : pair.hull[0].center.w;
    pair.plane_reach = kPlaneShare * (radius + abs(above)) + 2.0 * length(pair.motion);
    pair.smaller = radius;
    pair.rounding = kRounding * (2.0 * radius + length(pair.place[1]));
}

vec3 centerOfMass(HullPair pair, uint side) { return pair.place[side] - pair.axes[side] * pair.hull[side].center.xyz; }

float reachOf(HullPair pair, uint side) {
    float turning = length(pair.turning[side]);
    return turning > 0.0 ? turning * (length(pair.hull[side].center.xyz) + pair.hull[side].center.w) : 0.0;
}

// What turns slowly is found by the margin.
void boundTurning(inout HullPair pair) {
    float reach = reachOf(pair, 0u) + reachOf(pair, 1u);
    bool is_swift = reach > pair.margin;
    pair.turned_by = length(pair.turning[0]) + length(pair.turning[1]);
    pair.reach = is_swift ? reach + length(pair.motion) : 0.0;
    if (!is_swift) pair.turning[0] = pair.turning[1] = vec3(0.0);
}

HullPair loadPair(uvec2 of, NarrowPhasePush push) {
    HullPair pair;
    uvec4 a = pieces[of.x].ids, b = pieces[of.y].ids;
    pair.ids = uvec4(of, a.y, b.y);
    pair.planes = (a.z & uint(PIECE_PLANE)) | (b.z & uint(PIECE_PLANE)) << 1;
    pair.hull[0] = hulls[a.x];
    pair.hull[1] = hulls[b.x];
    loadPlaces(pair, push.duration, push.gravity.xyz);
    pair.motion *= push.duration;
    pair.drift *= push.step;
    float radius_a = pair.hull[0].center.w, radius_b = pair.hull[1].center.w;
    pair.smaller = min(radius_a, radius_b);
    pair.rounding = kRounding * (radius_a + radius_b);
    pair.plane_reach = 0.0;
    if (pair.planes != 0u) boundPlane(pair);
    pair.margin = min(push.speculative, MARGIN_SHARE * pair.smaller);
    boundTurning(pair);
    return pair;
}

// Returns whether B moves against A by more than the margin in the step.
bool isFast(HullPair pair) { return dot(pair.motion, pair.motion) > pair.margin * pair.margin; }

// Returns whether the first contact of this pair may hide sides and be hidden.
bool isFastOrTurns(HullPair pair) { return isFast(pair) || pair.reach > 0.0; }

// How far points of hulls that turn come closer along an axis from A to B, negative where they part: at p, dot of p with xyz, and w.
// `shift`: by which B has gone already. 0 of hulls that do not turn, or slowly: these are moved to where they meet.
vec4 closingAlong(HullPair pair, vec3 axis, vec3 shift) {
    if (pair.reach == 0.0) return vec4(0.0);
    vec3 of_a = cross(axis, pair.turning[0]), of_b = cross(axis, pair.turning[1]);
    return vec4(of_a - of_b, dot(of_b, centerOfMass(pair, 1u)) - dot(of_a, centerOfMass(pair, 0u)) - dot(axis, pair.motion - shift));
}

vec3 cornerAt(HullPair pair, bool of_a, uint vertex) {
    vec3 own = hull_vertices[(of_a ? pair.hull[0].first.x : pair.hull[1].first.x) + vertex].xyz;
    if ((pair.planes & (of_a ? 1u : 2u)) != 0u) own.xz = clamp(own.xz, -pair.plane_reach, pair.plane_reach);
    own -= of_a ? pair.hull[0].center.xyz : pair.hull[1].center.xyz;
    return of_a ? own : pair.axes[1] * own + pair.place[1];
}

#endif
