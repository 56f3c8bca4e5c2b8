// What there is of a world to be drawn: for each slot of a body two draw commands, of its surface and of faces of cuts, without
// instances where there is nothing; its matrix, from the frame of its vertices to the place that the host draws about; whose it
// is.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/quaternion.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/debris.h"
#include "shared/drawing.h"
#include "shared/scene.h"

FLAT_KERNEL;
READS(0, BodyState, bodies);
READS(1, BreakableBody, breakable);
READS(2, BodyLook, looks);
READS(3, DebrisClock, clocks);
READS(4, DrawnFrom, from);
WRITES(5, DrawCommand, commands);
WRITES(6, ObjectMatrix, matrices);
WRITES(7, DrawnBody, drawn);
layout(push_constant) uniform Push {
    uint slots;
    uint breaks;          // 0: nothing does, and `breakable` is something else
    float fades_after;    // s; less than 0: nothing fades
    float fade_duration;
};

#include "lib/origin.glsl"

float leftOf(uint slot) {
    if (fades_after < 0.0) return 1.0;
    float over = clocks[slot].offset.w - fades_after;
    return over <= 0.0 ? 1.0 : max(0.0, 1.0 - over / max(fade_duration, 1e-6));
}

// Of a unit cube of the vertices' frame, whose axes and origin these are.
mat4 modelOf(BodyState body, vec4 turn, vec3 balance, float scale) {
    mat3 axes = scale * matrixOf(turnAfter(body.turn, turn));
    vec3 place = vec3(body.sector.xyz - from[0].sector.xyz) * float(SECTOR_EDGE) + (body.offset.xyz - from[0].offset.xyz);
    return mat4(vec4(axes[0], 0.0), vec4(axes[1], 0.0), vec4(axes[2], 0.0), vec4(place - axes * balance, 1.0));
}

void writeDraws(uint slot, uvec3 surface, bool present) {
    commands[2u * slot] = DrawCommand(surface.y, present ? 1u : 0u, surface.x, 0, 2u * slot);
    commands[2u * slot + 1u] = DrawCommand(surface.z, present ? 1u : 0u, surface.x + surface.y, 0, 2u * slot + 1u);
}

void main() {
    uint slot = flatIndex();
    if (slot >= slots) return;
    BodyState body = bodies[slot];
    bool present = (body.sector.w & BODY_ABSENT) == 0, can_break = breaks != 0u && breakable[slot].surface.w != NO_INDEX;
    uvec3 surface = can_break ? breakable[slot].surface.xyz : looks[slot].surface.xyz;
    vec4 turn = can_break ? breakable[slot].turn : vec4(0.0, 0.0, 0.0, 1.0);
    vec3 balance = can_break ? breakable[slot].balance.xyz : vec3(0.0);
    float left = leftOf(slot);
    uint origin = can_break ? originOf(slot) : slot, step_made = can_break ? bornIn(slot) : 0u;
    writeDraws(slot, surface, present);
    matrices[slot].model = modelOf(body, turn, balance, left);
    drawn[slot] = DrawnBody(looks[slot].surface.w, step_made, looks[origin].surface.w, left);
}
