// Surfaces of fragments that become bodies, a workgroup a fragment: from the event's pools to the world's, back in meters, which
// rounds nothing, and their bounds. A lane takes every GROUP_SIZE-th corner, so that a surface may have four million of them
// before a lane of Mesa's software device runs out of turns. Runs once for each part of the world's list.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/breaking.h"
#include "shared/fragment_record.h"
#include "shared/scene.h"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, FragmentRecord, fragments);
READS(2, ivec4, sites);
READS(3, BreakingRecord, breaking);
READS(4, uvec4, rooms);
READS(5, SceneVertex, event_vertices);
WRITES(6, SceneVertex, vertices); // of one part of the list of surfaces
UPDATES(7, BreakableBody, breakable);
layout(push_constant) uniform Push { uint first_vertex, end_vertex; }; // of the part
#include "lib/whose_fragment.glsl"

shared vec3 lows[GROUP_SIZE];
shared vec3 highs[GROUP_SIZE];

// Of every step-th lane below `end` to the lane's own.
void joinFrom(uint lane, uint step, uint end) {
    vec3 low = lows[lane], high = highs[lane];
    for (uint k = lane + step; k < (lane < step ? end : 0u); k += step) {
        low = min(low, lows[k]);
        high = max(high, highs[k]);
    }
    if (lane < step) {
        lows[lane] = low;
        highs[lane] = high;
    }
}

// In two rounds: on Mesa's software device each of the six of a tree costs as much as if all lanes were in it.
void joinBounds(uint lane) {
    barrier();
    joinFrom(lane, 8u, GROUP_SIZE);
    barrier();
    if (lane == 0u) joinFrom(0u, 1u, 8u);
}

void main() {
    uint f = flatGroup(), lane = gl_LocalInvocationID.x;
    if (f >= counts[COUNT_FRAGMENTS] || counts[STATUS_FAILED] != 0u) return;
    uvec4 room = rooms[f], range = fragments[f].range;
    uint first = 3u * room[ROOM_TRIANGLES];
    if (room[ROOM_BODY] >= ROOM_OF_DUST || first < first_vertex || first >= end_vertex) return;
    float unit = inversePower(breaking[objectOfFragment(f)].center.w);
    vec3 low = vec3(1e38), high = vec3(-1e38);
    for (uint k = lane; k < 3u * (range.z + range.w); k += GROUP_SIZE) {
        SceneVertex v = event_vertices[3u * range.y + k];
        vec3 p = unit * vec3(v.position[0], v.position[1], v.position[2]);
        for (uint c = 0u; c < 3u; c++) v.position[c] = p[c];
        vertices[first - first_vertex + k] = v;
        low = min(low, p);
        high = max(high, p);
    }
    lows[lane] = low;
    highs[lane] = high;
    joinBounds(lane);
    if (lane != 0u) return;
    breakable[room[ROOM_BODY]].low.xyz = lows[0];
    breakable[room[ROOM_BODY]].high.xyz = highs[0];
}
