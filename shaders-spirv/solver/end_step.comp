// A step ends: bodies stand where they have moved to, as far as they may go (lib/held_way.glsl). Where it failed they stay where
// they were, and it does not count.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/rigid.glsl"
#include "lib/sector.glsl"
#include "lib/held_way.glsl"
#include "lib/effect.glsl"

FLAT_KERNEL;
CCD_EFFECT;
UPDATES(0, uint, counts);
UPDATES(1, BodyState, bodies);
READS(2, BodyShape, shapes);
READS(3, SolverBody, solver_bodies);
READS(4, vec4, spins);
UPDATES(5, uint, steps);
READS(6, uint, shares);
READS(7, uint, adjacency_start);
READS(8, uint, adjacency); // a contact << 1, | 1 where the body is its B
READS(9, StopImpulse, stops);
layout(push_constant) uniform Push { vec4 gravity; }; // w: length of the step
#include "lib/take_up_spin.glsl"
#include "lib/solver_body.glsl"

void moveTo(uint b, vec3 offset) {
    ivec3 sectors = sectorsIn(offset);
    bodies[b].sector.xyz += sectors;
    bodies[b].offset.xyz = offsetWithin(offset, sectors);
}

bool isFinite(vec3 v) { return all(notEqual(floatBitsToUint(v) & uvec3(0x7f800000u), uvec3(0x7f800000u))); }

// What floats cannot hold would spread to all that it touches: the body stays where it was, at rest, and the host is told.
void stop(uint b) {
    bodies[b].velocity.xyz = vec3(0.0);
    bodies[b].spin.xyz = vec3(0.0);
    bodies[b].momentum.xyz = vec3(0.0);
    atomicMax(counts[STATUS_STOPPED_BODY], b + 1u);
}

vec2 shareFor(uint b, vec3 moved) {
    float own = shareOfWay(moved, bodies[b].velocity.xyz, gravity, thicknessOf(shapes[b]));
    float way = min(uintBitsToFloat(shares[2u * b]), own);
    return vec2(way, min(way, uintBitsToFloat(shares[2u * b + 1u])));
}

// Without what gravity gave it in the time that it has lost.
vec3 velocityAtEnd(uint b, vec3 velocity, float lost) {
    vec3 falling = gravity.w * gravity.xyz;
    float gained = dot(velocity - bodies[b].velocity.xyz, falling) / max(dot(falling, falling), 1e-37);
    return velocity - lost * clamp(gained, 0.0, 1.0) * falling;
}

// What bodies that hang in it, or that it hangs in, take from its motion, in the order of its contacts.
void slow(uint b, inout SolverBody s) {
    Moving m = movingOf(s);
    vec3 impulse = vec3(0.0), twist = vec3(0.0);
    for (uint k = adjacency_start[b]; k < adjacency_start[b + 1u]; k++) {
        StopImpulse stop = stops[adjacency[k] >> 1];
        bool is_slowed = (stop.impulse.w != 0.0) == ((adjacency[k] & 1u) != 0u);
        impulse += is_slowed ? stop.impulse.xyz : -stop.impulse.xyz;
        twist += is_slowed ? stop.twist.xyz : stop.back.xyz;
    }
    s.velocity.xyz = m.velocity + m.inverse_mass * impulse;
    // The inverse inertia of a chip may be no float: nothing of it is nothing.
    if (twist != vec3(0.0)) s.spin.xyz = m.spin + spinBy(m, twist);
}

void noteHeld(uint b, bool held) {
    int flags = bodies[b].sector.w;
    bodies[b].sector.w = held ? flags | BODY_HELD : flags & ~BODY_HELD;
}

void main() {
    uint b = flatIndex();
    if (b >= counts[COUNT_BODIES] || counts[STATUS_FAILED] != 0u) return;
    if (b == 0u) steps[STEPS_MADE]++;
    SolverBody s = solver_bodies[b];
    if (s.velocity.w == 0.0) return;
    if (kCcd != 0u && counts[COUNT_SWIFT] != 0u) slow(b, s);
    vec4 from = bodies[b].turn, turn = normalize(turnAfter(s.turned, from));
    mat3 own = ownInverseInertia(shapes[b]);
    vec3 momentum = takeUpSpin(b, own, turn, s.spin.xyz), spin = s.spin.xyz;
    vec2 share = kCcd != 0u ? shareFor(b, s.moved.xyz) : vec2(1.0);
    if (share.y < 1.0) {
        vec4 held = normalize(turnAfter(shareOfTurn(s.turned, share.y), from)), back = turnAfter(held, turnBack(turn));
        // Along with the body, or it would have another energy.
        bodies[b].momentum.xyz = turned(back, momentum);
        spin = turned(back, spin);
        turn = held;
    }
    if (!(isFinite(s.moved.xyz) && isFinite(s.velocity.xyz) && isFinite(spin) && isFinite(bodies[b].momentum.xyz) && isFinite(turn.xyz))) {
        stop(b);
        return;
    }
    if (kCcd != 0u) noteHeld(b, uintBitsToFloat(shares[2u * b + 1u]) < 1.0);
    moveTo(b, bodies[b].offset.xyz + share.x * s.moved.xyz);
    bodies[b].turn = turn;
    bodies[b].velocity.xyz = velocityAtEnd(b, s.velocity.xyz, 1.0 - share.x);
    bodies[b].spin.xyz = spin;
}
