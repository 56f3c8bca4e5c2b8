// What separates fragments of one body is known when they come apart: each lies in its Voronoi cell, and the cells of any two on
// their own sides of the plane halfway between their sites. So no axis is looked for between them in the step after it broke: that
// plane keeps them apart, or it is where their faces touch. Afterwards it turns with the first of the two, and as long as it parts them by
// more than the margin, or both have a face along it, nothing is looked for either: while fragments fly apart that is so for most.
// What is left for the search is what nearly touches in an edge or a corner, what has tumbled, and parts of one cell. A lane a pair.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/hull.h"
#include "shared/narrow_phase.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec2, pairs);
READS(2, PieceRecord, pieces);
READS(3, BodyState, bodies);
READS(4, HullRecord, hulls);
READS(5, vec4, hull_vertices);
READS(6, HullFace, hull_faces);
READS(7, Birth, births);
READS(8, uint, steps);
WRITES(9, AxisRecord, axis_records);
layout(push_constant) uniform Push { NarrowPhasePush push; };

#include "lib/hull_pair.glsl"

const float kFar = 3e38;
const float kSquare = 1.0 - 1e-3;  // cosine, of faces that lie along the plane: 2.5 degrees
const float kDeepestShare = 1e-4;  // of the smaller hull: deeper than rounding makes it, and somebody else has to look
const float kLeastApart = 1e-12;   // squared, of sites, by the squared distance of the hulls

bool areSiblings(HullPair pair) {
    uvec2 a = births[pair.ids.z].of.xy, b = births[pair.ids.w].of.xy;
    return a.y != 0u && a == b;
}

// No step has gone by since.
bool areFresh(HullPair pair) { return births[pair.ids.z].of.y == steps[STEPS_MADE]; }

// From the site of A to that of B as A has turned since, in the frame of the pair; 0 where both are one.
vec3 betweenSites(HullPair pair) {
    Birth a = births[pair.ids.z], b = births[pair.ids.w];
    vec3 way = turned(turnBack(a.turn), b.site.xyz - a.site.xyz);
    return dot(way, way) > kLeastApart * dot(pair.place[1], pair.place[1]) ? normalize(way) : vec3(0.0);
}

// The furthest of A and the nearest of B along an axis.
vec2 heightsAlong(HullPair pair, vec3 axis) {
    vec2 heights = vec2(-kFar, kFar);
    for (uint v = 0u; v < min(pair.hull[0].count.x, uint(HULL_VERTICES)); v++)
        heights.x = max(heights.x, dot(axis, cornerAt(pair, true, v)));
    for (uint v = 0u; v < min(pair.hull[1].count.x, uint(HULL_VERTICES)); v++)
        heights.y = min(heights.y, dot(axis, cornerAt(pair, false, v)));
    return heights;
}

// The face that looks most squarely along the axis, and how squarely, as bits.
uvec2 squarestFace(HullPair pair, uint side, vec3 axis) {
    vec3 own = axis * pair.axes[side];
    uint best = 0u;
    float most = -kFar;
    for (uint f = 0u; f < min(pair.hull[side].count.y, uint(HULL_FACES)); f++) {
        float cosine = dot(own, hull_faces[pair.hull[side].first.y + f].plane.xyz);
        best = cosine > most ? f : best;
        most = max(most, cosine);
    }
    return uvec2(best, floatBitsToUint(most));
}

AxisRecord unknown() { return AxisRecord(vec4(0.0), vec4(0.0), uvec4(AXIS_UNKNOWN, 0u, 0u, 0u)); }

AxisRecord recordOf(uint feature, vec3 axis, vec2 heights, uint a, uint b) {
    return AxisRecord(vec4(axis, heights.y - heights.x), vec4(vec3(0.0), heights.x), uvec4(feature, 0u, a, b));
}

// Near each other: where both have a face along the plane.
AxisRecord touching(HullPair pair, vec3 between) {
    uvec2 a = squarestFace(pair, 0u, between), b = squarestFace(pair, 1u, -between);
    if (min(uintBitsToFloat(a.y), uintBitsToFloat(b.y)) < kSquare) return unknown();
    vec3 axis = hull_faces[pair.hull[0].first.y + a.x].plane.xyz;
    return recordOf(AXIS_FACE_A << AXIS_KIND_SHIFT | a.x, axis, heightsAlong(pair, axis), a.x, b.x);
}

AxisRecord separated(HullPair pair, vec3 axis) {
    vec2 heights = heightsAlong(pair, axis);
    float gap = heights.y - heights.x;
    if (gap + min(dot(axis, pair.motion), 0.0) > pair.margin + pair.reach) return AxisRecord(vec4(vec3(0.0), gap), vec4(0.0), uvec4(AXIS_APART));
    bool is_fast = dot(pair.motion, pair.motion) > pair.margin * pair.margin;
    if (gap > pair.margin + pair.reach || (is_fast && !areFresh(pair))) return unknown();
    AxisRecord found = touching(pair, axis);
    return found.axis.w >= -kDeepestShare * pair.smaller - pair.rounding ? found : unknown();
}

void main() {
    uint k = flatIndex();
    if (k >= min(counts[push.count_at], push.capacity)) return;
    HullPair pair = loadPair(pairs[k], push);
    vec3 axis = areSiblings(pair) ? betweenSites(pair) : vec3(0.0);
    if (axis == vec3(0.0)) axis_records[k] = unknown();
    else axis_records[k] = separated(pair, axis);
}
