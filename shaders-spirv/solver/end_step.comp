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
layout(push_constant) uniform Push { vec4 gravity; }; // w: length of the step
#include "lib/take_up_spin.glsl"

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

vec3 falling = gravity.w * gravity.xyz; // in the step

// Of what gravity would have given it, in free fall 1.
float gainedBy(uint b, vec3 velocity) {
    return dot(velocity - bodies[b].velocity.xyz, falling) / max(dot(falling, falling), 1e-37);
}

// Without what gravity gave it in the time that it has lost.
vec3 velocityAtEnd(vec3 velocity, float gained, float lost) { return velocity - lost * clamp(gained, 0.0, 1.0) * falling; }

void noteBorne(uint b, float gained) {
    bool is_borne = falling != vec3(0.0) && gained < 0.5;
    bodies[b].sector.w = is_borne ? bodies[b].sector.w | BODY_BORNE : bodies[b].sector.w & ~BODY_BORNE;
}

// A body that is held once hangs. One that goes further than its own radius in a step may tumble along a floor: it hangs only if it is held
// in BODY_HELD / BODY_HELD_ONCE steps in a row.
int withHeld(int flags, bool held, bool goes_far) {
    int steps = held ? min((flags & BODY_HELD) + BODY_HELD_ONCE, BODY_HELD) : 0;
    bool hangs = held && (!goes_far || steps == BODY_HELD);
    return (flags & ~(BODY_HELD | BODY_HANGS)) | steps | (hangs ? BODY_HANGS : 0);
}

bool goesFar(uint b) { return gravity.w * length(solver_bodies[b].velocity.xyz) > reachOf(shapes[b]); }

// What hangs in something that does not move comes to rest there, or it would keep a speed with which it goes nowhere.
float shareOfSpeed(uint b) {
    bool hung = (bodies[b].sector.w & BODY_HANGS) != 0;
    float share = uintBitsToFloat(shares[2u * b + 1u]);
    bodies[b].sector.w = withHeld(bodies[b].sector.w, share < 1.0, goesFar(b));
    return hung ? share : 1.0;
}

void main() {
    uint b = flatIndex();
    if (b >= counts[COUNT_BODIES] || counts[STATUS_FAILED] != 0u) return;
    if (b == 0u) steps[STEPS_MADE]++;
    SolverBody s = solver_bodies[b];
    if (s.velocity.w == 0.0) return;
    vec4 from = bodies[b].turn, turn = normalize(turnAfter(s.turned, from));
    mat3 own = ownInverseInertia(shapes[b]);
    vec3 momentum = takeUpSpin(b, own, turn, s.spin.xyz), spin = s.spin.xyz;
    Way way = wayOf(s, bodies[b].velocity.xyz, bodies[b].spin.xyz, gravity, thicknessOf(shapes[b]));
    float share = kCcd != 0u ? min(uintBitsToFloat(shares[2u * b]), way.share) : 1.0;
    if (share < 1.0) {
        vec4 held = normalize(turnAfter(turnedAt(way, share), from)), back = turnAfter(held, turnBack(turn));
        // Along with the body, or it would have another energy.
        bodies[b].momentum.xyz = turned(back, momentum);
        spin = turned(back, spin);
        turn = held;
    }
    if (!(isFinite(s.moved.xyz) && isFinite(s.velocity.xyz) && isFinite(spin) && isFinite(bodies[b].momentum.xyz) && isFinite(turn.xyz))) {
        stop(b);
        return;
    }
    float slowed = kCcd != 0u ? shareOfSpeed(b) : 1.0, gained = gainedBy(b, s.velocity.xyz);
    noteBorne(b, gained);
    vec3 moved = share < 1.0 ? placeAt(way, share) : s.moved.xyz;
    moveTo(b, bodies[b].offset.xyz + moved);
    bodies[b].turn = turn;
    bodies[b].velocity.xyz = slowed * velocityAtEnd(s.velocity.xyz, gained, 1.0 - share);
    bodies[b].spin.xyz = slowed * spin;
    bodies[b].momentum.xyz *= slowed;
}
