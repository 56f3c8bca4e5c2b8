// Bodies that their fragments have taken the place of are absent, and what they took from the pools goes to the lists of what has
// been given back, in the order of objects. One workgroup; a lane takes every GROUP_SIZE-th object.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/hull.h"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, BrokenBody, broken);
READS(2, uint, adopted);
READS(3, BodyShape, shapes);
READS(4, HullRecord, hulls);
UPDATES(5, BodyState, bodies);
UPDATES(6, BreakableBody, breakable);
UPDATES(7, PieceRecord, pieces);
UPDATES(8, uint, returned_count); // ranges in each list
WRITES(9, uvec2, returned);       // begin, size; a list a pool, in the order ROOM_*, one after the other
layout(push_constant) uniform Push { uint room; }; // of a list, in ranges

void giveBack(uint at, uint pool, uint begin, uint size) {
    if (at < room) returned[pool * room + at] = uvec2(begin, size);
}

// Hulls of a body follow each other.
void giveBackAll(uint at, uint body) {
    uvec2 range = shapes[body].pieces.xy;
    uvec4 surface = breakable[body].surface;
    HullRecord first = hulls[pieces[range.x].ids.x], last = hulls[pieces[range.x + range.y - 1u].ids.x];
    giveBack(at, ROOM_BODY, body, 1u);
    giveBack(at, ROOM_PIECE, range.x, range.y);
    giveBack(at, ROOM_FACES, first.first.y, last.first.y + last.count.y - first.first.y);
    giveBack(at, ROOM_TRIANGLES, surface.x / 3u, (surface.y + surface.z) / 3u);
}

void retire(uint body) {
    uvec2 range = shapes[body].pieces.xy;
    for (uint p = 0u; p < range.y; p++) pieces[range.x + p].ids.y = NO_INDEX;
    breakable[body].surface.w = NO_INDEX;
    bodies[body].offset.w = 0.0;
    bodies[body].velocity = vec4(0.0);
    bodies[body].spin = vec4(0.0);
    bodies[body].momentum = vec4(0.0);
}

uint adoptedBefore(uint object) {
    uint before = 0u;
    for (uint k = 0u; k < object; k++) before += adopted[k] != 0u ? 1u : 0u;
    return before;
}

void main() {
    uint lane = gl_LocalInvocationID.x, begin = returned_count[0];
    barrier();
    if (counts[STATUS_FAILED] != 0u) return;
    uint objects = counts[COUNT_BREAKING];
    for (uint k = lane; k < objects; k += GROUP_SIZE) {
        if (adopted[k] != 0u) {
            giveBackAll(begin + adoptedBefore(k), broken[k].ids.x);
            retire(broken[k].ids.x);
        }
    }
    if (lane == 0u) returned_count[0] = begin + adoptedBefore(objects);
}
