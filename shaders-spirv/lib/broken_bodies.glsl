// The bodies that a blow breaks in this step, where each is hit, and what shape it has there. Wants `world_counts`, `memory`, `bodies`,
// `shapes`, `blows`, `chosen` and `breakable` declared, with STRIKES also `records`.
#ifndef BROKEN_BODIES_GLSL
#define BROKEN_BODIES_GLSL
#include "lib/break_pattern.glsl"
#include "lib/breaking_laws.glsl"
#include "lib/plate_shape.glsl"
#include "lib/quaternion.glsl"
#include "lib/takes_part.glsl"

shared uint flags[GROUP_SIZE];
shared uint listed[MOST_BREAKING]; // bodies that break, by number
shared uint found;

bool isByHand(uint pair) { return STRIKES != 0 && pair != NO_INDEX && (pair & STRUCK_BY_HAND) != 0u; }

uint sideOf(uint body, uint pair) { return memory[pair].ids.x == body ? BREAKS_A : BREAKS_B; }

// Chosen by both, unless the other takes part in any number of blows, and hard enough for this one.
bool isBroken(uint body) {
    uint pair = chosen[body];
    if (pair == NO_INDEX || isByHand(pair)) return pair != NO_INDEX;
    uvec2 ids = memory[pair].ids.xy;
    uint other = ids.x == body ? ids.y : ids.x;
    bool agreed = chosen[other] == pair || !takesPart(other);
    return agreed && (blows[pair].sides.x & sideOf(body, pair)) != 0u;
}

void listBroken(uint lane) {
    if (lane == 0u) found = 0u;
    uint bodies_ = world_counts[COUNT_BODIES];
    for (uint first = 0u; first < bodies_; first += GROUP_SIZE) {
        uint body = first + lane;
        flags[lane] = body < bodies_ && isBroken(body) ? 1u : 0u;
        barrier();
        uint before = 0u, all_ = 0u;
        for (uint k = 0u; k < GROUP_SIZE; k++) {
            before += k < lane ? flags[k] : 0u;
            all_ += flags[k];
        }
        uint at = found + before;
        if (flags[lane] != 0u && at < MOST_BREAKING) listed[at] = body;
        barrier();
        if (lane == 0u) found = min(found + all_, uint(MOST_BREAKING));
        barrier();
    }
}

BlowRecord blowOf(uint body) {
    uint pair = chosen[body];
#if STRIKES
    if (isByHand(pair)) {
        vec3 arm = turned(bodies[body].turn, records[body].arm.xyz), along = turned(bodies[body].turn, records[body].along.xyz);
        return BlowRecord(uvec4(BREAKS_A, 0u, 0u, 0u), records[body].blow, vec4(arm, 0.0), vec4(0.0), vec4(along, 0.0));
    }
#endif
    return blows[pair];
}

// The place of the blow, from the body's center of mass, along the world's axes.
vec3 armOf(uint body) {
    BlowRecord blow = blowOf(body);
    uint pair = chosen[body];
    return !isByHand(pair) && memory[pair].ids.x != body ? blow.arm_b.xyz : blow.arm_a.xyz;
}

// To the furthest place of its surface's bounds.
float furthestFrom(uint body, vec3 place) {
    return length(max(place - breakable[body].low.xyz, breakable[body].high.xyz - place));
}

uint trianglesOf(uint body) { return (breakable[body].surface.y + breakable[body].surface.z) / 3u; }
uint patternOf(uint body) { return uint(breakable[body].high.w); }
BodyForm formOfBody(uint body) { return formOf(breakable[body].form.x, breakable[body].form.y); }

// Edges of the box that weighs as it does, along its own axes; without mass those of its surface's bounds.
vec3 edgesOf(uint body) {
    BreakableBody b = breakable[body];
    if (bodies[body].offset.w == 0.0) return b.high.xyz - b.low.xyz;
    vec3 moments = vec3(1.0 / shapes[body].inverse_inertia[0].x, 1.0 / shapes[body].inverse_inertia[1].y, 1.0 / shapes[body].inverse_inertia[2].z);
    vec3 squares = 0.5 * (moments.x + moments.y + moments.z) - moments;
    return sqrt(max(12.0 * bodies[body].offset.w * squares, 0.0));
}

// A plane that all of a flat body lies near, in the frame of its vertices.
struct Plane {
    bool is_flat;
    float depth; // all of it lies within, on either side
    vec2 edges;  // along the two that follow
    vec3 across;
    vec3 along;
};

const float kFlat = 3.0; // times as wide as thick, both ways

Plane planeOf(uint body) {
    vec3 edges = edgesOf(body);
    uint thin = edges.x <= edges.y && edges.x <= edges.z ? 0u : edges.y <= edges.z ? 1u : 2u, next = (thin + 1u) % 3u, last = (thin + 2u) % 3u;
    vec4 turn = bodies[body].offset.w == 0.0 ? vec4(0.0, 0.0, 0.0, 1.0) : turnBack(breakable[body].turn);
    vec3 across = vec3(0.0), along = vec3(0.0);
    across[next] = 1.0;
    along[last] = 1.0;
    return Plane(kFlat * edges[thin] < min(edges[next], edges[last]), edges[thin], vec2(edges[next], edges[last]), turned(turn, across), turned(turn, along));
}

int placementOf(uint body, bool is_flat) {
    bool even = patternOf(body) == PATTERN_UNIFORM, thin = isThin(formOfBody(body));
    if (patternOf(body) == PATTERN_PAPER) return SITES_PAPER;
    if (thin && is_flat) return even ? SITES_FLAT_EVEN : patternOf(body) == PATTERN_RADIAL ? SITES_RADIAL : SITES_FLAT;
    return even ? SITES_EVEN : thin ? SITES_SHELL : SITES_SOLID;
}

vec3 blowInFrameOf(uint body, vec3 arm) {
    BreakableBody b = breakable[body];
    return turned(turnBack(b.turn), turned(turnBack(bodies[body].turn), arm)) + b.balance.xyz;
}

bool isRadial(uint body) { return patternOf(body) == PATTERN_RADIAL && placementOf(body, planeOf(body).is_flat) == SITES_RADIAL; }

#endif
