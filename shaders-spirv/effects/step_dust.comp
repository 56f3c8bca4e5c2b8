// Particles fall through the air for a step, a lane a particle that flies: the drag of a ball (Schiller and Naumann 1933; above their
// Reynolds numbers the constant 0.44), taken at the end of the step, so that no step is too long for it. They bounce off
// planes, whose ground is rough, until they lie there, and settle after their time.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/dust.h"
#include "shared/material.h"
#include "shared/solver.h"
#include "lib/sector.glsl"

FLAT_KERNEL;
READS(0, uint, world_counts);
READS(1, uint, steps);
READS(2, DustPlane, planes);
UPDATES(3, uint, state);
UPDATES(4, DustParticle, ring);
layout(push_constant) uniform Push {
    vec4 gravity; // w: length of the step
    float density, viscosity; // of the air, kg/m3 and Pa s
    uint lifetime; // steps
    uint plane_count;
    uint capacity;
};
#include "lib/dust_mass.glsl"
#include "lib/hash.glsl"

const float kBounce = 0.4;   // of the speed that it comes in with
const float kGrip = 0.3;     // of the speed along the ground, that is lost
const float kRoughness = 0.5;
const float kStill = 0.2;    // m/s: what leaves more slowly lies

// 1/s, of its speed through the air.
float dragRate(float speed, float radius, float mass) {
    float diameter = 2.0 * radius, reynolds = density * speed * diameter / viscosity;
    float beyond_stokes = max(1.0 + 0.15 * pow(reynolds, 0.687), 0.44 / 24.0 * reynolds);
    return 3.0 * 3.14159265 * viscosity * diameter * beyond_stokes / mass;
}

vec3 velocityAfter(vec3 velocity, float radius, float mass) {
    vec3 falling = velocity + gravity.w * gravity.xyz;
    bool in_air = density > 0.0 && mass > 0.0;
    return in_air ? falling / (1.0 + gravity.w * dragRate(length(velocity), radius, mass)) : falling;
}

float chance(uint hash) { return (float(hash >> CHANCE_SHIFT) + 0.5) * float(CHANCE_STEP); }

// Of the ground where a particle meets it.
vec3 tilted(vec3 normal, uint hash) {
    vec3 any = 2.0 * vec3(chance(mixed(hash)), chance(mixed(hash + 1u)), chance(mixed(hash + 2u))) - 1.0;
    return normalize(normal + kRoughness * any);
}

// With no more energy than before; nothing where it lies from now on.
vec3 thrownBack(vec3 velocity, vec3 normal, vec3 rough) {
    vec3 after = velocity - (1.0 + kBounce) * min(dot(velocity, rough), 0.0) * rough;
    float up = dot(after, normal);
    return up < kStill ? vec3(0.0) : up * normal + (1.0 - kGrip) * (after - up * normal);
}

void fall(inout DustParticle p, uint hash) {
    vec3 velocity = velocityAfter(p.velocity.xyz, p.place.w, p.velocity.w), place = p.place.xyz + gravity.w * velocity;
    for (uint k = 0u; k < plane_count; k++) {
        vec3 n = planes[k].normal.xyz, way = vec3(p.sector.xyz - planes[k].sector.xyz) * float(SECTOR_EDGE) + (place - planes[k].offset.xyz);
        float height = dot(n, way) - p.place.w;
        if (height > 0.0 || height < -DUST_PLANE_DEPTH) continue;
        place -= height * n;
        velocity = thrownBack(velocity, n, tilted(n, hash));
        p.birth.z = velocity == vec3(0.0) ? 1u : 0u;
    }
    ivec3 sectors = sectorsIn(place);
    p.sector.xyz += sectors;
    p.place.xyz = offsetWithin(place, sectors);
    p.velocity.xyz = velocity;
}

void main() {
    uint k = flatIndex();
    if (k >= state[DUST_NEXT] - state[DUST_FIRST] || world_counts[STATUS_FAILED] != 0u) return;
    uint at = (state[DUST_FIRST] + k) % capacity;
    DustParticle p = ring[at];
    if (steps[STEPS_MADE] - p.birth.x >= lifetime) {
        addMass(DUST_SETTLED_MASS, p.velocity.w);
        atomicAdd(state[DUST_AGED], 1u);
        return;
    }
    if (p.birth.z != 0u) return;
    fall(p, mixed(state[DUST_FIRST] + k) + steps[STEPS_MADE]);
    ring[at] = p;
}
