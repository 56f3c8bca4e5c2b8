// Bodies that are fast for their size go no deeper into what they touch than a share of their thickness, however a blow has
// turned them: of a contact's normal nothing is asked but that it separates, so all corners of both hulls count, not only the
// points that were found before the blow. The least of all contacts is what a body may go of its way (end_step).
//
// Ways are swept when contacts are found, turns are not: so a body goes all of its way and turns less, if that is enough, and only
// else stops on its way too. Two that are both fast stop at one time, or one would pass the other. One that is not stays out of
// it, or a splinter would stop a rock: it moves by less than half of its thickness, so that what it runs over is pushed out on the
// side that it came from. For the same reason something much lighter holds nothing that moves by less than all of that.
//
// What was held in the last step already hangs in something, and is slowed towards it (StopImpulse) where that goes on without it,
// or it would keep a speed with which it goes nowhere.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/hull.h"
#include "lib/held_way.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, contact_pairs);
READS(2, uvec2, pairs);
READS(3, ContactMemory, memory);
READS(4, PieceRecord, pieces);
READS(5, HullRecord, hulls);
READS(6, vec4, hull_vertices);
READS(7, BodyState, bodies);
READS(8, BodyShape, shapes);
READS(9, SolverBody, solver_bodies);
UPDATES(10, uint, shares); // two of each body, of its way and of its turn, as bits: of floats that are not negative the order is the same
READS(11, uint, contact_slots);
READS(12, uint, adjacency_start);
WRITES(13, StopImpulse, stops); // in the order of contacts
layout(push_constant) uniform Push {
    vec4 gravity; // w: length of the step
    float margin;
};
#include "lib/body_way.glsl"
#include "lib/stop_impulse.glsl"

const uint kHalvings = 12u;
const float kDepthShare = 0.25; // of the thinner hull along the normal
const float kMarginShare = 0.1; // of the smaller hull
const float kRoom = 0.1;        // of what is allowed, for bodies that begin deeper
const float kMuchLighter = 0.01;

struct Side {
    uint body;
    HullRecord hull;
    vec4 from, turned_; // at the beginning of the step, and since
    vec3 moved;
    float share;        // that its own way allows
    bool is_held;       // by what it meets
};

bool isHeldBy(uint body, uint other, float share) {
    SolverBody s = solver_bodies[body];
    bool light = kMuchLighter * solver_bodies[other].velocity.w > s.velocity.w;
    float way = share * length(s.moved.xyz), turn = 2.0 * length(s.turned.xyz);
    return s.velocity.w != 0.0 && isSwift(way, turn, shapes[body], light ? 1.0 : kSwift);
}

Side sideOf(uint body, uint other, uint piece) {
    SolverBody s = solver_bodies[body];
    bool moves = s.velocity.w != 0.0;
    float share = moves ? shareOfWay(s.moved.xyz, bodies[body].velocity.xyz, gravity, thicknessOf(shapes[body])) : 1.0;
    return Side(body, hulls[pieces[piece].ids.x], bodies[body].turn, s.turned, s.moved.xyz, share, isHeldBy(body, other, share));
}

float shareAt(Side side, float share) { return side.is_held ? min(share, side.share) : side.share; }

vec4 turnAt(Side side, float share) { return turnAfter(shareOfTurn(side.turned_, shareAt(side, share)), side.from); }

// The lowest and the highest corner along a direction, above the body's center of mass.
vec2 heightsOf(Side side, vec4 turn, vec3 n) {
    vec3 own = turned(turnBack(turn), n);
    vec2 heights = vec2(3e38, -3e38);
    for (uint v = 0u; v < HULL_VERTICES && v < side.hull.count.x; v++) {
        float height = dot(own, hull_vertices[side.hull.first.x + v].xyz);
        heights = vec2(min(heights.x, height), max(heights.y, height));
    }
    return heights;
}

// How deep the hulls lie in each other along the normal; yz: how thick they are. The normal turns with the larger one: the corners
// of the other tell how far it has got, while a wide floor has its own far below a normal that tips over. `share`: of the ways and
// of the turns.
vec3 depthAt(uint pair, Side a, Side b, vec3 way, vec2 share) {
    bool with_a = a.hull.center.w > b.hull.center.w;
    vec4 turn_a = turnAt(a, share.y), turn_b = turnAt(b, share.y);
    vec4 since = with_a ? turnAfter(turn_a, turnBack(memory[pair].turn_a)) : turnAfter(turn_b, turnBack(memory[pair].turn_b));
    vec3 n = turned(since, memory[pair].normal.xyz);
    vec2 of_a = heightsOf(a, turn_a, n), from_b = heightsOf(b, turn_b, n);
    vec3 apart = way + shareAt(b, share.x) * b.moved - shareAt(a, share.x) * a.moved;
    return vec3(of_a.y - from_b.x - dot(n, apart), of_a.y - of_a.x, from_b.y - from_b.x);
}

// What begins deeper may go on a little, to get out of each other's way; but not ever deeper into what does not move, step by step.
float allowedDepth(vec3 first, Side a, Side b) {
    float slight = min(margin, kMarginShare * min(a.hull.center.w, b.hull.center.w));
    float allowed = max(kDepthShare * min(first.y, first.z), slight);
    bool both_move = solver_bodies[a.body].velocity.w != 0.0 && solver_bodies[b.body].velocity.w != 0.0;
    return max(allowed, first.x + kRoom * (both_move ? allowed : clamp(2.0 * allowed - first.x, 0.0, allowed)));
}

// First as it began, then the whole step, then all of the way without turning, then halves. y: of the turns.
vec2 shareWithin(uint pair, Side a, Side b, vec3 way) {
    vec2 low = vec2(0.0), high = vec2(1.0);
    float allowed = 0.0;
    bool open = a.is_held || b.is_held, held = false;
    for (uint k = 0u; k < ROLLED(kHalvings + 3u) && open; k++) {
        vec2 share = k < 2u ? vec2(float(k)) : (k == 2u ? vec2(1.0, 0.0) : 0.5 * (low + high));
        vec3 depth = depthAt(pair, a, b, way, share);
        if (k == 0u) allowed = allowedDepth(depth, a, b);
        bool fits = depth.x <= allowed;
        if (fits) low = share;
        else if (k != 2u) high = share;
        held = held || !fits;
        open = k == 0u || held;
    }
    return held ? low : vec2(1.0);
}

void hold(Side side, vec2 share) {
    if (!side.is_held) return;
    atomicMin(shares[2u * side.body], floatBitsToUint(share.x));
    atomicMin(shares[2u * side.body + 1u], floatBitsToUint(share.y));
}

bool hangs(Side side) { return side.is_held && (bodies[side.body].sector.w & BODY_HELD) != 0; }

// Only what the other one does not stop with: two that are both held have lost the same time, and none of it in the other.
StopImpulse stopOf(Side a, Side b, vec3 way) {
    if (hangs(b) && !a.is_held) return stopTowards(b.body, a.body, way, true);
    if (hangs(a) && !b.is_held) return stopTowards(a.body, b.body, -way, false);
    return noStop();
}

void main() {
    uint at = flatIndex();
    if (at >= counts[COUNT_SWIFT]) return;
    uint pair = contact_pairs[at];
    uvec2 ids = memory[pair].ids.xy, of = pairs[pair];
    Side a = sideOf(ids.x, ids.y, of.x), b = sideOf(ids.y, ids.x, of.y);
    vec3 way = wayBetween(ids.x, ids.y);
    vec2 share = shareWithin(pair, a, b, way);
    hold(a, share);
    hold(b, share);
    if (share.y < 1.0) stops[contact_slots[at]] = stopOf(a, b, way);
    else stops[contact_slots[at]] = noStop();
}
