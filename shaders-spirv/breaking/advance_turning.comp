// Where and when bodies meet that turn on the way to each other. The narrow phase finds points along the way, but not along the turn:
// by the time that a long bar has come down, another of its corners may be the lowest, and it meets sooner or later and with another
// part of its mass. So for such pairs it is asked again, some times over: each time with both bodies standing as they will when they
// meet by what the time before has found (Newton's method), in a list of bodies and pieces of their own. Where they have gone into
// each other before the step began, that is a time in the past.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/contact.h"
#include "shared/material.h"
#include "shared/narrow_phase.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec2, pairs);
READS(2, BodyState, bodies);
READS(3, BodyShape, shapes);
READS(4, SolverBody, solver_bodies);
READS(5, PieceRecord, pieces);
READS(6, Manifold, manifolds); // of the time before
UPDATES(7, TurningBlow, turning);
WRITES(8, BodyState, posed_bodies);
WRITES(9, PieceRecord, posed_pieces);
WRITES(10, uvec2, posed_pairs);
WRITES(11, AxisRecord, axes);
READS(12, BreakableBody, breakable);
READS(13, MaterialCard, cards);
READS(14, uint, steps);
layout(push_constant) uniform Push {
    vec4 gravity; // w: length of a substep, s
    float duration;
    uint is_first;
};
#include "lib/turning_contact.glsl"
#include "lib/most_closing.glsl"

const float kFurthest = 2.0; // steps ahead
const float kBack = 1.0;

// Where no point comes closer, or there is none, another may: they go on for as long as they cannot meet along the axis, or, where that
// is not known, along any (conservative advancement, Mirtich 1996).
void goCloser(float gap, vec3 axis, inout TurningBlow t) {
    float closing = mostClosing(t.ids.y, t.ids.z, axis, gravity.xyz, duration);
    t.ids.w = gap > 0.0 && closing > 0.0 ? 0u : 1u;
    t.time = vec4(t.time.x + gap / closing, t.time.x, gap, 0.0);
}

void goOn(uint k, TurningContact c, inout TurningBlow t) {
    if (c.closing <= 0.0 && !isWithin(c, t)) goCloser(c.separation, manifolds[k].normal.xyz, t);
    else t.time = vec4(meetingTime(c, t), c.separation > 0.0 ? vec2(t.time.x, c.separation) : t.time.yz, 0.0);
}

void setTime(uint k, inout TurningBlow t) {
    if (manifolds[k].info.x == 0u) goCloser(manifolds[k].normal.w, vec3(0.0), t);
    else goOn(k, contactOf(k, t), t);
    if (t.time.x > kFurthest * duration) t.ids.w = 1u;
    t.time.x = max(t.time.x, -kBack * duration);
}

void pose(uint slot, uint body, uint piece, float time) {
    BodyState b = bodies[body];
    Flight f = flightOf(body, movesOf(body), time);
    b.offset.xyz += f.way;
    b.turn = f.turn;
    b.velocity.xyz = f.velocity;
    b.spin.xyz = f.spin;
    posed_bodies[slot] = b;
    posed_pieces[slot].ids = uvec4(pieces[piece].ids.x, slot, pieces[piece].ids.zw);
}

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_TURNING]) return;
    TurningBlow t = turning[k];
    if (is_first == 0u && t.ids.w == 0u) setTime(k, t);
    turning[k] = t;
    uvec2 of = pairs[t.ids.x];
    for (uint side = 0u; side < 2u; side++) pose(2u * k + side, side == 0u ? t.ids.y : t.ids.z, side == 0u ? of.x : of.y, t.time.x);
    posed_pairs[k] = uvec2(2u * k, 2u * k + 1u);
    axes[k].info.x = AXIS_UNKNOWN;
}
