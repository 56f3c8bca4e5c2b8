// Boxes of pieces for the broad phase: of where a piece is, where it will be at the end of the step and on the way, and a margin. Places far from
// the origin round, so there boxes are wider.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/quaternion.glsl"
#include "lib/trigonometry.glsl"
#include "shared/body.h"
#include "shared/hull.h"
#include "shared/broad_phase.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, PieceRecord, pieces);
READS(2, BodyState, bodies);
READS(3, HullRecord, hulls);
READS(4, vec4, hull_vertices);
WRITES(5, vec4, box_low);
WRITES(6, vec4, box_high);
layout(push_constant) uniform Push {
    vec4 gravity; // w: length of the step
    float margin;
};

const float kRounding = 1.0 / 4194304.0;
const float kWholeTurn = 6.2831853;
const float kEndless = 4e6; // m, further than bodies can be

vec4 turnAhead(BodyState body, float angle) {
    if (angle == 0.0) return body.turn;
    vec2 half_turn = sineAndCosine(0.5 * angle);
    return turnAfter(vec4(half_turn.x * normalize(body.spin.xyz), half_turn.y), body.turn);
}

// How far an arc leads beyond its chord.
float bulgeOf(HullRecord hull, float angle) {
    return (length(hull.center.xyz) + hull.center.w) * (1.0 - sineAndCosine(0.5 * min(angle, kWholeTurn)).y);
}

// Of a plane, beyond its hull: along each axis as far as it leads there.
vec3 endlessPart(vec4 turn) {
    vec3 up = turned(turn, vec3(0.0, 1.0, 0.0));
    return kEndless * sqrt(max(1.0 - up * up, vec3(0.0)));
}

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_BOXES]) return;
    uvec4 ids = pieces[p].ids;
    if (ids.y == NO_INDEX) {
        box_low[p] = vec4(3e38);
        box_high[p] = vec4(-3e38);
        return;
    }
    BodyState body = bodies[ids.y];
    bool moves = body.offset.w != 0.0;
    HullRecord hull = hulls[ids.x];
    vec3 low = vec3(3e38), high = vec3(-3e38), low_ahead = low, high_ahead = high;
    float angle = moves ? gravity.w * length(body.spin.xyz) : 0.0, bulge = angle > 0.0 ? bulgeOf(hull, angle) : 0.0;
    vec4 turn_ahead = turnAhead(body, angle);
    for (uint v = 0u; v < HULL_VERTICES && v < hull.count.x; v++) {
        vec3 own = hull_vertices[hull.first.x + v].xyz, arm = turned(body.turn, own), arm_ahead = turned(turn_ahead, own);
        low = min(low, arm);
        high = max(high, arm);
        low_ahead = min(low_ahead, arm_ahead);
        high_ahead = max(high_ahead, arm_ahead);
    }
    vec3 way = moves ? gravity.w * body.velocity.xyz : vec3(0.0), origin = vec3(body.sector.xyz) * float(SECTOR_EDGE) + body.offset.xyz;
    vec3 beyond = (ids.z & uint(PIECE_PLANE)) != 0u ? endlessPart(body.turn) : vec3(0.0);
    low = origin + min(low, low_ahead + way) - margin - bulge - beyond;
    high = origin + max(high, high_ahead + way) + margin + bulge + beyond;
    low -= abs(low) * kRounding;
    high += abs(high) * kRounding;
    box_low[p] = vec4(low, uintBitsToFloat(ids.y));
    box_high[p] = vec4(high, uintBitsToFloat(moves ? 0u : BOX_STATIC));
}
