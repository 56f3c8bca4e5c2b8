// Boxes of pieces for the broad phase: of where a piece is, where it will be at the end of the step, and a margin. Places far from
// the origin round, so there boxes are wider.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/quaternion.glsl"
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
const float kEndless = 4e6; // m, further than bodies can be

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
    vec3 low = vec3(3e38), high = vec3(-3e38);
    for (uint v = 0u; v < HULL_VERTICES && v < hull.count.x; v++) {
        vec3 arm = turned(body.turn, hull_vertices[hull.first.x + v].xyz);
        low = min(low, arm);
        high = max(high, arm);
    }
    vec3 way = moves ? gravity.w * body.velocity.xyz : vec3(0.0), origin = vec3(body.sector.xyz) * float(SECTOR_EDGE) + body.offset.xyz;
    vec3 beyond = (ids.z & uint(PIECE_PLANE)) != 0u ? endlessPart(body.turn) : vec3(0.0);
    low = origin + min(low, low + way) - margin - beyond;
    high = origin + max(high, high + way) + margin + beyond;
    low -= abs(low) * kRounding;
    high += abs(high) * kRounding;
    box_low[p] = vec4(low, uintBitsToFloat(ids.y));
    box_high[p] = vec4(high, uintBitsToFloat(moves ? 0u : BOX_STATIC));
}
