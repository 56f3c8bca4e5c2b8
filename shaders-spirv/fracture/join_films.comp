// Finds hosts for films, so that no volume is lost: a film goes to the piece behind its largest cap, if it
// lies within that cell but for a few grid steps, else of the one behind the next largest. Runs in rounds, a workgroup a
// film: only pieces whose fate was known before the round take films up, so that chains of films end at a fragment.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/fragment_record.h"

#define MOST_HOSTS 6
#define STEPS_OUTSIDE 8.0
GROUP_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, films);
READS(2, uint, component_start);
READS(3, uint, order);
READS(4, uvec4, pieces);
READS(5, uint, sources);
READS(6, uint, parents);
READS(7, uint, components);
READS(8, vec4, positions);
READS(9, FragmentRecord, records);
READS(10, ivec4, sites);
READS(11, uvec4, cell_offsets);
READS(12, uint, neighbors);
UPDATES(13, uvec2, fates);
layout(push_constant) uniform Push {
    uint round;
    float unit;
    float step_size; // of the grid, in box units
};
#include "lib/piece_behind.glsl"
#include "lib/rounded_alike.glsl"
#include "lib/tile.glsl"

shared float lane_area[GROUP_SIZE];
shared uint lane_pick[GROUP_SIZE];

vec3 cornerOf(uint id) { return positions[id].xyz * unit; }
vec3 siteOf(uint s) { return vec3(inTile(sites[s].xyz) - ivec3(1 << 23)) * step_size; }

// Four times the squared area. Caps of equal area are common, and which is the larger must not depend on a square root.
float squaredAreaOf(uvec4 piece) {
    precise vec3 a = cornerOf(piece.x), u = cornerOf(piece.y) - a, v = cornerOf(piece.z) - a;
    vec3 normal = alikeCross(u, v);
    return alikeDot(normal, normal);
}

// The fragment behind one side of a cap, NO_INDEX where its fate was open when the round began.
uint hostBehind(uint side) {
    uint mate = components[pieceBehind(side, counts[COUNT_MESH_TRIANGLES] + counts[COUNT_FAN_TRIANGLES])];
    uvec2 fate = fates[mate != NO_INDEX ? mate : 0u];
    bool settled = fate.x == FATE_FRAGMENT || (fate.x >= FATE_JOINED && fate.x < FATE_JOINED + round);
    return mate != NO_INDEX && settled ? fate.y : NO_INDEX;
}

// Leaves the host behind the film's largest cap in lane_pick[0], those in `tried` left out.
void largestCap(uint lane, uint first, uint last, uint tried[MOST_HOSTS], uint tries) {
    float largest = -1.0;
    uint pick = NO_INDEX;
    for (uint k = first + lane; k < last; k += GROUP_SIZE) {
        uint t = order[k];
        bool cap = (sources[t] & INNER_BIT) != 0u;
        uint host = cap ? hostBehind(t) : NO_INDEX;
        for (uint s = 0u; s < MOST_HOSTS; s++) host = s < tries && tried[s] == host ? NO_INDEX : host;
        float area = host != NO_INDEX ? squaredAreaOf(pieces[t]) : -1.0;
        bool better = host != NO_INDEX && (area > largest || (area == largest && host < pick));
        largest = better ? area : largest;
        pick = better ? host : pick;
    }
    lane_area[lane] = largest;
    lane_pick[lane] = pick;
    barrier();
    for (uint width = ROLLED(GROUP_SIZE / 2u); width > 0u; width >>= 1) {
        if (lane < width) {
            float area = lane_area[lane + width];
            uint host = lane_pick[lane + width];
            if (area > lane_area[lane] || (area == lane_area[lane] && host < lane_pick[lane])) {
                lane_area[lane] = area;
                lane_pick[lane] = host;
            }
        }
        barrier();
    }
}

// How far the film's corners lie outside of a cell, at most; in lane_area[0].
void reachOutside(uint lane, uint first, uint last, uint cell) {
    uint from = cell_offsets[cell].x, to = cell_offsets[cell + 1u].x;
    vec3 own = siteOf(cell);
    float furthest = 0.0;
    for (uint k = first + lane; k < last; k += GROUP_SIZE) {
        uvec4 piece = pieces[order[k]];
        vec3 a = cornerOf(piece.x), b = cornerOf(piece.y), d = cornerOf(piece.z);
        for (uint n = from; n < to; n++) {
            vec3 other = siteOf(neighbors[n]), way = normalize((other - own) / step_size), middle = 0.5 * (own + other);
            furthest = max(furthest, max(dot(a - middle, way), max(dot(b - middle, way), dot(d - middle, way))));
        }
    }
    lane_area[lane] = furthest;
    barrier();
    for (uint width = ROLLED(GROUP_SIZE / 2u); width > 0u; width >>= 1) {
        if (lane < width) lane_area[lane] = max(lane_area[lane], lane_area[lane + width]);
        barrier();
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    bool idle = counts[STATUS_FAILED] != 0u || flatGroup() >= counts[COUNT_FILMS];
    uint c = idle ? 0u : films[flatGroup()], first = component_start[c], last = component_start[c + 1u];
    if (idle || fates[c].x != FATE_FILM) return;
    uint tried[MOST_HOSTS], tries = 0u, found = NO_INDEX, turns = (last - first) / GROUP_SIZE + 1u;
    for (uint attempt = 0u; attempt < ROLLED(MOST_HOSTS) && tries == attempt && found == NO_INDEX; attempt++) {
        largestCap(lane, first, last, tried, tries);
        uint host = lane_pick[0];
        barrier();
        uint cell = host != NO_INDEX ? records[host].fate.z : 0u;
        // Mesa's software device has 65,535 loop turns for all of this.
        bool fits = host != NO_INDEX && (turns + 8u) * (cell_offsets[cell + 1u].x - cell_offsets[cell].x + 8u) < MOST_TURNS / MOST_HOSTS;
        reachOutside(lane, first, fits ? last : first, cell);
        bool within = fits && lane_area[0] <= STEPS_OUTSIDE * step_size;
        barrier();
        found = within ? host : NO_INDEX;
        if (host != NO_INDEX) tried[tries++] = host;
    }
    if (lane == 0u && found != NO_INDEX) {
        fates[c] = uvec2(FATE_JOINED + round, found);
        atomicAdd(counts[STATUS_JOINED], 1u);
    }
}
