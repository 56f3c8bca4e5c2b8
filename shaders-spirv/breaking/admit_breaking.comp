// Which bodies break in this step, and how: all whose blow was chosen, in their order, as long as the step has room for what they
// make. One workgroup. What the step has no room for waits for the next step, held where it is. What no step has room for, or the
// world, does not break, and the host is told.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/half_edge.glsl"
#include "lib/radial_law.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/material.h"
#include "shared/pool.h"
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
READS(6, MaterialCard, cards);
READS(7, uint, steps);
UPDATES(8, BreakableBody, breakable);
UPDATES(9, BreakingRecord, breaking);
UPDATES(10, BrokenBody, broken);
UPDATES(11, uint, counts); // of the event
UPDATES(12, uint, args);
READS(13, uint, reach_sums); // of bodies that break in rays; of others it is not read
READS(14, PoolHeader, pools);
#if STRIKES
UPDATES(15, StrikeRecord, records);
#endif
layout(push_constant) uniform Push {
    uint most_bodies, most_triangles, most_sites; // of one step
    uint most_fragments; // of one body
    uint seed;
    uint most_pairs, most_contacts; // that the world has room for; NO_INDEX: it makes more where it must
    float duration, margin;         // s, of a step; m, at which contacts are looked for
    float pause;                    // s, in which what could not be broken is left alone
    uint kept_for_each;  // fragments, for each body of the scene that has not broken yet
    uint kept_for_whole; // for all of them together, by fragments that break again
};
#include "lib/origin.glsl"
#include "lib/publish.glsl"
#include "lib/broken_bodies.glsl"

const uint kAnyNumber = 0xffffffu; // of fragments

shared uint sites_of[MOST_BREAKING];
shared float paid_of[MOST_BREAKING];
shared uvec2 pairs_of[MOST_BREAKING];
shared uvec2 neighbors_of[MOST_BREAKING]; // pairs that each is in; those of them with another that breaks
shared uint admitted[MOST_BREAKING];
shared float reach_of[MOST_BREAKING];
shared uvec2 lacked; // of what is unfit

// Of the blow's energy, what is this body's.
float joulesOf(BlowRecord blow) { return blow.blow.z * (blow.sides.x == (BREAKS_A | BREAKS_B) ? 0.5 : 1.0); }

// Not of the step that it breaks in: with steps of another length it would break in another way.
uint seedOf(uint body) { return mixed(mixed(seed + body) + bornIn(body)); }

// How far it is from the blow to the rim in the body's plane, on the average of all directions (`measure_reach`).
float reachOf(uint k, uint body) {
    float unit = furthestFrom(body, blowInFrameOf(body, armOf(body))) / REACH_STEPS;
    return max(float(reach_sums[k]), 1.0) * unit / (2.0 * 6.2832);
}

float chanceFor(uint body, uint salt) { return float(mixed(seedOf(body) ^ salt) >> CHANCE_SHIFT) * CHANCE_STEP; }

// `most`: cells.
Rays raysOf(uint k, uint body, uint most) {
    BlowRecord blow = blowOf(body);
    BodyForm form = formOfBody(body);
    MaterialCard card = cards[breakable[body].surface.w];
    float long_ = card.cracks.z * joulesOf(blow) / card.cracks.y / form.thickness, furthest = furthestFrom(body, blowInFrameOf(body, armOf(body)));
    return raysFor(long_, blow.blow.y, form.side, reach_of[k], furthest, most, chanceFor(body, 0x5bd1e995u), chanceFor(body, 0x2545f491u));
}

// Of a plate, with what its shape and the place of the blow make of its cracks.
BodyForm formUnderBlow(uint body) {
    BodyForm form = formOfBody(body);
    Plane plane = planeOf(body);
    if (!isThin(form) || !plane.is_flat) return form;
    vec3 off = blowInFrameOf(body, armOf(body)) - breakable[body].balance.xyz;
    form.outline = 2.0 * (plane.edges.x + plane.edges.y) * inversesqrt(plane.edges.x * plane.edges.y);
    if (spreadOf(patternOf(body)) == SPREAD_ABOUT_BLOW) form.crowded = crowdedIn(plane.edges, vec2(dot(off, plane.across), dot(off, plane.along)));
    return form;
}

// How the paper's sites crowd.
float favorFor(uint body) {
    float joules = joulesOf(blowOf(body));
    BodyForm form = formOfBody(body);
    vec3 middle = 0.5 * (breakable[body].low.xyz + breakable[body].high.xyz);
    return isThin(form) ? favorInPlate(joules, distance(blowInFrameOf(body, armOf(body)), middle) / form.side) : favorOf(joules);
}

// That the blow pays for, as a whole number, and so many of them as a body may have; two at least, since it breaks.
void countFragments(uint k, uint body) {
    MaterialCard card = cards[breakable[body].surface.w];
    uint spread = spreadOf(patternOf(body)), paid;
    if (isRadial(body)) {
        for (uint turn = 0u; turn < ROLLED(2); turn++) {
            Rays rays = raysOf(k, body, turn == 0u ? kAnyNumber : most_fragments);
            sites_of[k] = rays.spokes * rays.rings;
            paid = turn == 0u ? sites_of[k] : paid;
        }
    } else {
        paid = max(fragmentCount(card, formUnderBlow(body), joulesOf(blowOf(body)), kAnyNumber, chanceFor(body, 0x5bd1e995u), spread, favorFor(body)), 2u);
        sites_of[k] = min(paid, most_fragments);
    }
    paid_of[k] = float(paid);
}

#include "lib/expected_pairs.glsl"
#include "lib/fragment_share.glsl"

uvec2 lackedBy(uvec2 asked, uvec2 room) { return asked - min(asked, room); }

uvec2 lackOf(uint k, uint why, uvec2 room) {
    if (why == WHOLE_NO_ROOM) return lackedBy(uvec2(min(sites_of[k], most_fragments)), uvec2(limit_of[k]));
    if (why == WHOLE_NO_PAIRS) return lackedBy(pairs_of[k], room);
    return lackedBy(uvec2(trianglesOf(listed[k]), sites_of[k]), uvec2(most_triangles, most_sites));
}

// Of what there is no room for, one a step is told: it stands behind what breaks. What no step has room for never breaks.
void tellUnfit(uint k, uint why, uint at, uvec2 room) {
    bool never = why == WHOLE_TOO_LARGE;
    breakable[listed[k]].form.w = never ? kForEver : float(steps[STEPS_MADE] + 1u) * duration + pause;
    admitted[k] = at;
    lacked = lackOf(k, why, room);
    counts[STATUS_UNFIT] = why;
}

// In order, by one lane: there are few.
void admit() {
    uint unfit = NO_INDEX, why = 0u;
    lacked = uvec2(0u);
    uvec2 room = roomForPairs(), paired = uvec2(0u);
    uvec3 left = uvec3(min(most_bodies, uint(MOST_BREAKING)), most_triangles, most_sites), taken = uvec3(0u);
    for (uint k = 0u; k < found; k++) {
        uvec3 asked = uvec3(1u, trianglesOf(listed[k]), sites_of[k]);
        bool fits = isRoomFor(k) && all(lessThanEqual(taken + asked, left)) && all(lessThanEqual(paired + pairs_of[k], room));
        bool never = any(greaterThan(asked, left)), crowded = any(greaterThan(pairs_of[k], room));
        if (never || crowded || !isRoomFor(k)) {
            unfit = k;
            why = never ? WHOLE_TOO_LARGE : isRoomFor(k) ? WHOLE_NO_PAIRS : WHOLE_NO_ROOM;
        }
        admitted[k] = fits ? taken.x : NO_INDEX;
        if (fits) {
            breaking[taken.x].range.w = 3u * taken.y;
            breaking[taken.x].sites = uvec4(taken.z, asked.z, 0u, 0u);
            taken += asked;
            paired += pairs_of[k];
        }
    }
    if (unfit != NO_INDEX && taken.x < uint(MOST_BREAKING)) tellUnfit(unfit, why, taken.x, room);
    publishCount(COUNT_BREAKING, taken.x, NO_INDEX);
    publishCount(COUNT_SOUP_TRIANGLES, taken.y, NO_INDEX);
    publishCount(COUNT_SOUP_CORNERS, 3u * taken.y, NO_INDEX);
    publishCount(COUNT_ASKED_SITES, taken.z, NO_INDEX);
}

// Grid steps in half a grid's edge are a power of two, and so is this: nothing is rounded but the way to the center.
float unitOf(vec3 half_size) {
    int exponent;
    frexp(max(max(half_size.x, half_size.y), half_size.z), exponent);
    return ldexp(1.0, -exponent);
}

ivec3 onGridOf(vec4 center, vec3 place) { return onGrid((place - center.xyz) * center.w); }

// So wide that cells there are no smaller than the material's smallest. In a solid a quarter of the sites about the blow, which
// are half of all, fall within the contact's radius (lib/draw_impact.glsl); in what is thin as many as fall within
// (radius / furthest)^(2/3) (lib/draw_plate.glsl).
float leastRadiusFor(uint body, uint sites, float furthest) {
    float smallest = cards[breakable[body].surface.w].cracks.w, in_plate = float(sites) * smallest * smallest / 3.14159265;
    if (isThin(formOfBody(body))) return pow(in_plate / pow(furthest, 2.0 / 3.0), 0.75);
    return smallest * pow(float(sites) * 3.0 / (32.0 * 3.14159265), 1.0 / 3.0);
}

// Where the contact has grown to when it presses most (Hertz). Flat is what does not move: it is larger than what hits it.
float contactRadiusOf(uint body, uint other, BlowRecord blow) {
#if STRIKES
    if (other == NO_INDEX) return records[body].arm.w;
#endif
    float curved = 1.0 / shapes[body].inverse_inertia[2].w + (bodies[other].offset.w != 0.0 ? 1.0 / shapes[other].inverse_inertia[2].w : 0.0);
    uint material = breakable[other].surface.w;
    float other_modulus = material != NO_INDEX ? cards[material].elastic.y : float(RIGID_MODULUS), own = cards[breakable[body].surface.w].elastic.y;
    return hertzRadiusOf(Blow(blow.blow.x, blow.blow.y, float(RIGID_IMPEDANCE)), 1.0 / curved, 1.0 / (1.0 / own + 1.0 / other_modulus));
}

const float kAxisUnit = 16384.0;

// Of SITES_RADIAL: rings go on beyond the rim (lib/draw_radial.glsl).
const float kRoomForRings = 0.25; // of the grid is the object's

void setRecord(uint k, uint body, uint other, uint sites, Rays rays, BlowRecord blow) {
    BreakableBody b = breakable[body];
    vec3 place = blowInFrameOf(body, armOf(body));
    Plane plane = planeOf(body);
    int placement = placementOf(body, plane.is_flat);
    float room = placement == SITES_RADIAL ? kRoomForRings : 1.0;
    vec4 center = vec4(0.5 * (b.low.xyz + b.high.xyz), room * unitOf(0.5 * (b.high.xyz - b.low.xyz)));
    bool in_plane = placement == SITES_FLAT || placement == SITES_FLAT_EVEN || placement == SITES_RADIAL;
    vec3 normal = cross(plane.across, plane.along), to_middle = dot(b.balance.xyz - place, normal) * normal;
    if (in_plane) place += to_middle;
    ivec3 low = onGridOf(center, b.low.xyz), high = onGridOf(center, b.high.xyz), at = clamp(onGridOf(center, place), low, high);
    vec3 far = vec3(max(at - low, high - at));
    float grid = center.w * kHalfEdge, furthest = ceil(length(far)) + 1.0;
    float meters = max(contactRadiusOf(body, other, blow), leastRadiusFor(body, sites, furthest / grid));
    breaking[k].center = center;
    breaking[k].range.xyz = b.surface.xyz;
    breaking[k].impact = ivec4(at, int(clamp(meters * grid, 1.0, furthest)));
    breaking[k].low = ivec4(low, int(furthest));
    breaking[k].high = ivec4(high, int(seedOf(body)));
    if (placement == SITES_RADIAL) {
        breaking[k].sites.zw = uvec2(rays.spokes, uint(rays.ratio * 65536.0));
        breaking[k].impact.w = int(clamp(rays.innermost * grid, 1.0, furthest));
    }
    if (placement == SITES_PAPER) breaking[k].sites.z = uint(favorOf(broken[k].share.x) * 4294967040.0);
    breaking[k].across = ivec4(roundEven(plane.across * kAxisUnit), placement);
    breaking[k].along = ivec4(roundEven(plane.along * kAxisUnit), int(min(plane.depth * grid, furthest)) + 1);
}

void setBroken(uint k, uint body, uint sites, float paid, Rays rays) {
    uint pair = chosen[body];
    BlowRecord blow = blowOf(body);
    bool by_hand = isByHand(pair), is_b = !by_hand && memory[pair].ids.x != body;
    uint other = by_hand ? NO_INDEX : is_b ? memory[pair].ids.x : memory[pair].ids.y;
    vec3 normal = blow.along.xyz;
    float joules = cards[breakable[body].surface.w].cracks.z * joulesOf(blow);
    broken[k].ids = uvec4(body, other, pair, is_b ? 1u : 0u);
    broken[k].blow = vec4(blow.blow.xy, joules, 0.0);
    broken[k].share = vec4(joulesOf(blow), paid, lacked);
    broken[k].place = vec4(turned(turnBack(bodies[body].turn), armOf(body)), blow.blow.w);
    broken[k].along = vec4(is_b ? -normal : normal, 0.0);
    setRecord(k, body, other, sites, rays, blow);
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    if (world_counts[COUNT_BLOWS] == 0u || world_counts[STATUS_FAILED] != 0u) return;
    listBroken(lane);
    for (uint k = lane; k < found; k += GROUP_SIZE) {
        reach_of[k] = isRadial(listed[k]) ? reachOf(k, listed[k]) : 0.0;
        countFragments(k, listed[k]);
        neighbors_of[k] = uvec2(0u);
    }
    countWhole(lane);
    if (lane == 0u) shareRoom();
    barrier();
    for (uint k = lane; k < found; k += GROUP_SIZE) cutToShare(k, listed[k]);
    barrier();
    if (isRoomForPairsFixed()) countNeighbors(lane);
    barrier();
    for (uint k = lane; k < found; k += GROUP_SIZE) pairs_of[k] = pairsFor(k, listed[k]);
    barrier();
    if (lane == 0u) admit();
    barrier();
    for (uint k = lane; k < found; k += GROUP_SIZE) {
        if (admitted[k] == NO_INDEX) continue;
        Rays rays = isRadial(listed[k]) ? raysOf(k, listed[k], limit_of[k]) : Rays(0u, 0u, 0.0, 0.0);
        setBroken(admitted[k], listed[k], sites_of[k], paid_of[k], rays);
#if STRIKES
        records[listed[k]].what.x = 0u; // another blow that broke it first is as good
#endif
    }
}
