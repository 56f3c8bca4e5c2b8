// Bodies that are fast for their size go no deeper into what they touch than a share of their thickness, however a blow has
// turned them: of a contact's normal nothing is asked but that it separates, so all corners of both hulls count, not only the
// points that were found before the blow. The least of all contacts is what a body may go of its way (end_step). What does not move
// is told apart: a body that it holds time and again hangs in it.
//
// Two of which one is fast are both held, for one time: else one would go on into the other. But a splinter holds up no rock, as
// long as that moves by less than half of its thickness: what it runs over is then pushed out on the side that it came from.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/narrow_phase.h"
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
UPDATES(10, uint, shares); // two of each body, as bits: of floats that are not negative the order is the same
layout(push_constant) uniform Push {
    vec4 gravity; // w: length of the step
    float margin;
};
#include "lib/body_way.glsl"

const uint kHalvings = 12u;
const float kDepthShare = 0.25; // of the thinner hull along the normal
const float kRoom = 0.1;        // of what is allowed, for bodies that begin deeper
const float kMuchLighter = 0.01;

struct Side {
    uint body;
    HullRecord hull;
    vec4 from; // at the beginning of the step
    Way way;
    bool is_swift, is_held; // for its size; by the other one
};

bool moves(uint body) { return solver_bodies[body].velocity.w != 0.0; }

bool isMuchLighter(uint body, uint than) { return kMuchLighter * solver_bodies[body].velocity.w > solver_bodies[than].velocity.w; }

// What is much lighter holds only what is twice as swift.
bool isHeldBy(uint other, uint body, float way, float turn) {
    return !(moves(other) && isMuchLighter(other, body)) || isSwift(0.5 * way, 0.5 * turn, shapes[body]);
}

Side sideOf(uint body, uint piece, uint other) {
    SolverBody s = solver_bodies[body];
    Way way = wayOf(s, bodies[body].velocity.xyz, bodies[body].spin.xyz, gravity, thicknessOf(shapes[body]));
    float length_ = length(placeAt(way, way.share)), turn = 2.0 * length(s.turned.xyz);
    return Side(body, hulls[pieces[piece].ids.x], bodies[body].turn, way, moves(body) && isSwift(length_, turn, shapes[body]),
                isHeldBy(other, body, length_, turn));
}

float shareAt(Side side, float share) { return side.is_held ? min(share, side.way.share) : side.way.share; }

vec4 turnAt(Side side, float share) { return turnAfter(turnedAt(side.way, shareAt(side, share)), side.from); }

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
// of the other tell how far it has got, while a wide floor has its own far below a normal that tips over.
vec3 depthAt(uint pair, Side a, Side b, vec3 way, float share) {
    bool with_a = a.hull.center.w > b.hull.center.w;
    vec4 turn_a = turnAt(a, share), turn_b = turnAt(b, share);
    vec4 since = with_a ? turnAfter(turn_a, turnBack(memory[pair].turn_a)) : turnAfter(turn_b, turnBack(memory[pair].turn_b));
    vec3 n = turned(since, memory[pair].normal.xyz);
    vec2 of_a = heightsOf(a, turn_a, n), from_b = heightsOf(b, turn_b, n);
    vec3 apart = way + placeAt(b.way, shareAt(b, share)) - placeAt(a.way, shareAt(a, share));
    return vec3(of_a.y - from_b.x - dot(n, apart), of_a.y - of_a.x, from_b.y - from_b.x);
}

bool isFlat(Side side) { return side.hull.count.y == 2u; }

// How deep they may lie in each other. What is behind a triangle of a mesh by half of its thickness would be pushed out on the wrong side.
float usualDepth(float thickness_a, float thickness_b, Side a, Side b) {
    float slight = min(margin, MARGIN_SHARE * min(a.hull.center.w, b.hull.center.w));
    if (isFlat(a) != isFlat(b)) return kDepthShare * (isFlat(a) ? thickness_b : thickness_a);
    return max(kDepthShare * min(thickness_a, thickness_b), slight);
}

// A pair that begins deeper may go on a little, so that bodies get out of each other's way. Into a fixed body it may not go deeper in each step.
float allowedDepth(vec2 thickness, float first, Side a, Side b) {
    float allowed = usualDepth(thickness.x, thickness.y, a, b), deepest = (isFlat(a) || isFlat(b) ? 1.5 : 2.0) * allowed;
    return max(allowed, first + kRoom * (moves(a.body) && moves(b.body) ? allowed : clamp(deepest - first, 0.0, allowed)));
}

// First as it began, then the whole step, then halves.
float shareWithin(uint pair, Side a, Side b, vec3 way) {
    float low = 0.0, high = 1.0, allowed = 0.0, first = 0.0;
    bool open = a.is_swift || b.is_swift, held = false, thins = isFlat(a) || isFlat(b); // as it turns
    for (uint k = 0u; k < ROLLED(kHalvings + 2u) && open; k++) {
        float share = k == 0u ? 0.0 : (k == 1u ? 1.0 : 0.5 * (low + high));
        vec3 depth = depthAt(pair, a, b, way, share);
        if (k == 0u) first = depth.x;
        if (k == 0u || thins) allowed = allowedDepth(depth.yz, first, a, b);
        bool fits = depth.x <= allowed;
        low = fits ? share : low;
        high = fits ? high : share;
        held = held || !fits;
        open = k == 0u || held;
    }
    return held ? low : 1.0;
}

void hold(Side side, float share, bool by_moving) {
    if (!side.is_held) return;
    atomicMin(shares[2u * side.body], floatBitsToUint(share));
    if (!by_moving) atomicMin(shares[2u * side.body + 1u], floatBitsToUint(share));
}

void main() {
    uint at = flatIndex();
    if (at >= counts[COUNT_SWIFT]) return;
    uint pair = contact_pairs[at];
    uvec2 ids = memory[pair].ids.xy, of = pairs[pair];
    Side a = sideOf(ids.x, of.x, ids.y), b = sideOf(ids.y, of.y, ids.x);
    float share = shareWithin(pair, a, b, wayBetween(ids.x, ids.y));
    hold(a, share, moves(ids.y));
    hold(b, share, moves(ids.x));
}
