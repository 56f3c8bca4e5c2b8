// The fragment that each cavity belongs to: the smallest piece of its cell that contains it, by the solid angle at the middle of
// its largest triangle; corners may lie on the surface of the piece. A workgroup a cavity.
//
// FILMS: those that have no caps but slivers. They are no cavities but may be part of a fragment like one: walls of a slot that
// have come to lie on each other leave such films behind within a cell, and whether there is a little between them or they
// have passed through each other is rounding. Where nothing is around them they stay what they are.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/rounded_alike.glsl"
#include "shared/fragment_record.h"

#define MOST_AROUND 128
GROUP_KERNEL;
UPDATES(0, uint, counts);
#ifdef FILMS
READS(1, uint, films);
#define LISTED films
#define LIST_COUNT COUNT_FILMS
#else
READS(1, uint, cavities);
#define LISTED cavities
#define LIST_COUNT COUNT_CAVITIES
#endif
READS(2, uint, component_start);
READS(3, uint, order);
READS(4, uvec4, pieces);
READS(5, vec4, positions);
READS(6, FragmentRecord, records);
UPDATES(7, uvec2, fates);
layout(push_constant) uniform Push {
    float unit;
    float step_size; // of the grid, in box units
    float least;     // as of settle_films
};
#include "lib/film.glsl"

shared uint around[MOST_AROUND];
shared uint around_count;
shared float lane_sum[GROUP_SIZE];
shared uint lane_pick[GROUP_SIZE];

vec3 cornerOf(uint id) { return positions[id].xyz * unit; }

bool hasCaps(uint c) {
    vec4 measure = records[c].measure;
    return measure.y - measure.z > step_size * measure.w;
}

// Fragments, and of films with caps what will be one: their fate stands while other films' is found.
bool isSolid(uint o) {
#ifdef FILMS
    bool film = hasCaps(o) && fates[o].x == FATE_FILM && records[o].measure.x > least * filmVolume(records[o], step_size);
    return fates[o].x == FATE_FRAGMENT || film;
#else
    return fates[o].x != FATE_CAVITY;
#endif
}

// Lists the pieces whose bounds contain the cavity's, but for the rounding of these.
void listAround(uint lane, uint cavity) {
    if (lane == 0u) around_count = 0u;
    barrier();
    FragmentRecord mine = records[cavity];
    uint total = counts[COUNT_COMPONENTS];
    for (uint o = lane; o < total; o += GROUP_SIZE) {
        FragmentRecord r = records[o];
        bool holds = o != cavity && isSolid(o) && r.fate.z == mine.fate.z && r.measure.x > 0.0 &&
                     all(lessThanEqual(r.low.xyz, mine.low.xyz + step_size)) &&
                     all(greaterThanEqual(r.high.xyz, mine.high.xyz - step_size));
        uint at = holds ? atomicAdd(around_count, 1u) : MOST_AROUND;
        if (at < MOST_AROUND) around[at] = o;
    }
    barrier();
}

// The middle of the largest of the cavity's triangles, of equal ones that of the first.
vec3 middleOf(uint lane, uint cavity) {
    float largest = -1.0;
    uint pick = component_start[cavity], last = component_start[cavity + 1u];
    for (uint k = pick + lane; k < last; k += GROUP_SIZE) {
        uvec4 piece = pieces[order[k]];
        precise vec3 a = cornerOf(piece.x), u = cornerOf(piece.y) - a, v = cornerOf(piece.z) - a;
        vec3 normal = alikeCross(u, v);
        float area = alikeDot(normal, normal); // four times its square
        pick = area > largest ? k : pick;
        largest = max(area, largest);
    }
    lane_sum[lane] = largest;
    lane_pick[lane] = pick;
    barrier();
    for (uint width = ROLLED(GROUP_SIZE / 2u); width > 0u; width >>= 1) {
        if (lane < width) {
            float area = lane_sum[lane + width];
            uint other = lane_pick[lane + width];
            bool better = area > lane_sum[lane] || (area == lane_sum[lane] && other < lane_pick[lane]);
            lane_sum[lane] = better ? area : lane_sum[lane];
            lane_pick[lane] = better ? other : lane_pick[lane];
        }
        barrier();
    }
    uvec4 piece = pieces[order[lane_pick[0]]];
    barrier();
    return (cornerOf(piece.x) + cornerOf(piece.y) + cornerOf(piece.z)) / 3.0;
}

// How often component o winds around p: 1 inside, 0 outside.
float windingAround(uint lane, uint o, vec3 p) {
    float sum = 0.0;
    uint last = component_start[o + 1u];
    for (uint k = component_start[o] + lane; k < last; k += GROUP_SIZE) {
        uvec4 piece = pieces[order[k]];
        vec3 a = cornerOf(piece.x) - p, b = cornerOf(piece.y) - p, c = cornerOf(piece.z) - p;
        float la = length(a), lb = length(b), lc = length(c);
        sum += 2.0 * atan(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    lane_sum[lane] = sum;
    barrier();
    for (uint width = ROLLED(GROUP_SIZE / 2u); width > 0u; width >>= 1) {
        if (lane < width) lane_sum[lane] += lane_sum[lane + width];
        barrier();
    }
    float total = lane_sum[0];
    barrier();
    return total / (4.0 * 3.14159265);
}

// Whether o is to be preferred to the best so far: the smaller of two fragments, one of which may lie in a hollow of the other;
// a fragment to a film; the larger of two films.
bool isBetter(uint o, uint best) {
    if (best == NO_INDEX) return true;
    bool film = fates[o].x == FATE_FILM, other = fates[best].x == FATE_FILM;
    float mine = records[o].measure.x, least_volume = records[best].measure.x;
    if (film != other) return other;
    return mine == least_volume ? o < best : film == (mine > least_volume);
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    bool idle = counts[STATUS_FAILED] != 0u || flatGroup() >= counts[LIST_COUNT];
    uint cavity = LISTED[idle ? 0u : flatGroup()];
    if (idle) return;
#ifdef FILMS
    if (fates[cavity].x != FATE_FILM || hasCaps(cavity)) return;
#endif
    vec3 middle = middleOf(lane, cavity);
    listAround(lane, cavity);
    uint total = min(around_count, uint(MOST_AROUND)), best = NO_INDEX;
    for (uint k = 0u; k < total; k++) {
        bool inside = windingAround(lane, around[k], middle) > 0.5;
        best = inside && isBetter(around[k], best) ? around[k] : best;
    }
    if (lane == 0u) {
#ifdef FILMS
        if (best != NO_INDEX && around_count <= MOST_AROUND) fates[cavity] = uvec2(FATE_CAVITY, best);
#else
        if (best == NO_INDEX || around_count > MOST_AROUND) atomicAdd(counts[STATUS_BAD_UNION], 1u);
        bool gone = best != NO_INDEX && fates[best].x == FATE_DISSOLVED;
        fates[cavity] = uvec2(gone ? FATE_DISSOLVED : FATE_CAVITY, best == NO_INDEX ? cavity : best);
#endif
    }
}
