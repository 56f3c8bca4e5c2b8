// How far it is from a blow to the rim, of every body that breaks in rays. One workgroup. It runs once for each part of the list of
// surfaces, and each body is measured where its surface lies.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/radial_law.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/scene.h"
#include "shared/solver.h"
#include "shared/strike.h"

// Built twice: STRIKES is for worlds that a host has struck by hand.
#ifndef STRIKES
#define STRIKES 0
#endif

GROUP_KERNEL;
READS(0, uint, world_counts);
READS(1, ContactMemory, memory);
READS(2, BodyState, bodies);
READS(3, BodyShape, shapes);
READS(4, BlowRecord, blows);
READS(5, uint, chosen);
READS(6, BreakableBody, breakable);
READS(7, SceneVertex, vertices); // of one part of the list
WRITES(8, uint, reach_sums);     // by number of the body among those that break
#if STRIKES
READS(9, StrikeRecord, records);
#endif
layout(push_constant) uniform Push {
    uint first_vertex, end_vertex; // of the part
    uint most_triangles;           // of all bodies that break in a step
};
#include "lib/broken_bodies.glsl"

shared uint sum;

vec3 cornerOf(uint vertex) {
    uint v = vertex - first_vertex;
    return vec3(vertices[v].position[0], vertices[v].position[1], vertices[v].position[2]);
}

bool isInPart(uint body) { return breakable[body].surface.x >= first_vertex && breakable[body].surface.x < end_vertex; }

// The share of one triangle, in steps of the sum.
uint reachOver(uint triangle, vec3 place, Plane plane, float unit) {
    vec2 corners[3];
    for (uint c = 0u; c < 3u; c++) {
        vec3 at = cornerOf(triangle + c) - place;
        corners[c] = vec2(dot(at, plane.across), dot(at, plane.along));
    }
    return uint(inverseDistanceOver(corners[0], corners[1], corners[2]) / unit);
}

// In the body's plane, on the average of all directions (lib/radial_law.glsl): every place of the plane lies below one face and above
// another. Whole numbers, so that it does not matter which lane adds what.
void measureReach(uint k, uint body, uint lane) {
    vec3 place = blowInFrameOf(body, armOf(body));
    Plane plane = planeOf(body);
    float unit = furthestFrom(body, place) / REACH_STEPS;
    if (lane == 0u) sum = 0u;
    barrier();
    uint triangles = min(trianglesOf(body), most_triangles); // with more it never breaks
    for (uint t = lane; t < triangles; t += GROUP_SIZE)
        atomicAdd(sum, reachOver(breakable[body].surface.x + 3u * t, place, plane, unit));
    barrier();
    if (lane == 0u) reach_sums[k] = sum;
    barrier();
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    if (world_counts[COUNT_BLOWS] == 0u || world_counts[STATUS_FAILED] != 0u) return;
    listBroken(lane);
    for (uint k = 0u; k < found; k++) {
        if (isRadial(listed[k]) && isInPart(listed[k])) measureReach(k, listed[k], lane); // the same for all lanes
    }
}
