// Cells that are too small for bodies become particles, a lane a cell: in pairs that lie opposite each other about the cell's center
// of mass, so that this stays where it is, inside of its hull; each moves as the body did there. What is overwritten is counted
// first.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/quaternion.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/collider.h"
#include "shared/dust.h"
#include "shared/fragment_record.h"
#include "shared/material.h"
#include "shared/solver.h"
#include "lib/sector.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, order);
READS(2, FragmentRecord, fragments);
READS(3, ivec4, sites);
READS(4, ColliderRecord, colliders);
READS(5, ColliderFaceRecord, collider_faces);
READS(6, BreakingRecord, breaking);
READS(7, BrokenBody, broken);
READS(8, uvec4, rooms);
READS(9, BodyState, bodies);
READS(10, BreakableBody, breakable);
READS(11, uint, steps);
READS(12, uint, offsets);
UPDATES(13, uint, state);
UPDATES(14, DustParticle, ring);
READS(15, MaterialCard, cards);
layout(push_constant) uniform Push {
    float least_volume;
    uint capacity;
    uint seed;
};
#include "lib/dust_mass.glsl"
#include "lib/hash.glsl"
#include "lib/origin.glsl"
#include "lib/particles_of_cell.glsl"
#include "lib/whose_fragment.glsl"

const float kWithin = 0.95; // of the way to the hull

float chance(uint hash) { return (float(hash >> CHANCE_SHIFT) + 0.5) * float(CHANCE_STEP); }

vec3 directionOf(uint hash) {
    vec3 v = 2.0 * vec3(chance(mixed(hash)), chance(mixed(hash + 1u)), chance(mixed(hash + 2u))) - 1.0;
    return v / max(length(v), 1e-3);
}

// How far both ways along a line through the center stay in the hull, units of half a grid's edge.
float reachAlong(vec3 direction, vec3 center, ColliderRecord collider) {
    float reach = 3e38;
    for (uint k = 0u; k < min(collider.range.y, uint(COLLIDER_PLANES)); k++) {
        vec4 plane = collider_faces[collider.range.x + k].plane;
        float depth = max(plane.w - dot(plane.xyz, center), 0.0);
        reach = min(reach, depth / max(abs(dot(plane.xyz, direction)), 1e-6));
    }
    return collider.range.y == 0u ? 0.0 : reach;
}

// From the center of mass; the last of an odd number lies in it.
vec3 partOf(uint j, uint parts, uint hash, vec3 center, ColliderRecord collider) {
    if (j + 1u == parts && (parts & 1u) == 1u) return vec3(0.0);
    uint pair = mixed(hash + (j >> 1));
    vec3 direction = directionOf(pair);
    float way = kWithin * pow(chance(mixed(pair + 3u)), 1.0 / 3.0) * reachAlong(direction, center, collider);
    return (j & 1u) == 0u ? way * direction : -way * direction;
}

DustParticle particleAt(vec3 place, float mass, float radius, uint parent) {
    BodyState body = bodies[parent];
    vec3 way = turned(body.turn, turned(breakable[parent].turn, place - breakable[parent].balance.xyz));
    vec3 offset = body.offset.xyz + way;
    ivec3 sectors = sectorsIn(offset);
    return DustParticle(ivec4(body.sector.xyz + sectors, int(breakable[parent].surface.w)),
                        vec4(offsetWithin(offset, sectors), radius),
                        vec4(body.velocity.xyz + cross(body.spin.xyz, way), mass), uvec4(steps[STEPS_MADE], originOf(parent), 0u, 0u));
}

// Where there are more than the ring holds, the oldest make room, and the first of this very event are never there.
void put(uint number, DustParticle particle) {
    addMass(DUST_MADE_MASS, particle.velocity.w);
    if (state[DUST_NEXT] - number > capacity) {
        addMass(DUST_OVERWRITTEN_MASS, particle.velocity.w);
        return;
    }
    uint at = number % capacity, oldest = state[DUST_WAS_FIRST];
    bool flies_here = (number - oldest) % capacity < state[DUST_WAS_NEXT] - oldest;
    if (flies_here) addMass(DUST_OVERWRITTEN_MASS, ring[at].velocity.w);
    ring[at] = particle;
}

void main() {
    uint r = flatIndex();
    if (r >= counts[COUNT_FRAGMENTS] || counts[STATUS_FAILED] != 0u) return;
    uint f = order[r];
    if (rooms[f][ROOM_BODY] != ROOM_OF_DUST) return;
    uint object = objectOfFragment(f), parent = broken[object].ids.x;
    float scale = breaking[object].center.w, unit = inversePower(scale), volume = max(fragments[f].measure.x, 0.0);
    uint parts = particlesOfCell(volume, scale, least_volume), hash = mixed(mixed(mixed(seed + parent) ^ steps[STEPS_MADE]) + f);
    float cubic = volume * unit * unit * unit, inverse_mass = bodies[parent].offset.w;
    // What did not move weighed nothing: its dust does, as its material does.
    float density = inverse_mass > 0.0 ? 1.0 / (inverse_mass * breakable[parent].form.x) : cards[breakable[parent].surface.w].elastic.x;
    float mass = density * cubic;
    float share = wholeGrains(mass / float(parts)), rest = wholeGrains(mass - float(parts - 1u) * share);
    float radius = pow(0.2387324 * cubic / float(parts), 1.0 / 3.0); // 3 / (4 pi)
    vec3 center = fragments[f].balance.xyz;
    for (uint j = 0u; j < parts; j++) {
        vec3 place = unit * (center + partOf(j, parts, hash, center, colliders[f])) + breaking[object].center.xyz;
        put(state[DUST_WAS_NEXT] + offsets[r] + j, particleAt(place, j + 1u == parts ? rest : share, radius, parent));
    }
}
