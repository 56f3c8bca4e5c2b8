// A plane between two islands of one cell, a workgroup a pair: along one of the fixed directions, else by the method of Gilbert,
// Johnson and Keerthi (1988), which steps towards the point of the islands' difference that is nearest to the origin. The method
// runs in fp32 and only proposes; what it proposes is rounded to whole numbers, and holds if the heights of both islands along
// it, in whole numbers, leave them apart. Where none holds there is none, or it is finer than rounding: the pair is listed as not
// parted.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/collider.h"
#include "lib/support_directions.glsl"
#include "lib/wide.glsl"
#include "lib/support_plane.glsl"
#include "lib/closest_point.glsl"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, uint, parting_list);
READS(2, uvec2, island_pairs);
READS(3, uvec2, fragment_list);
READS(4, uint, component_start);
READS(5, uint, order);
READS(6, uvec4, pieces);
READS(7, vec4, positions);
READS(8, int, supports);
READS(9, ivec4, sites);
WRITES(10, uint, partings);
READS(11, uvec2, parting_ranges);
layout(push_constant) uniform Push {
    float fine; // units of height in a model unit
    uint pairs; // of directions that have been measured
};

const uint kMostSteps = 48u;
const float kLargestNormal = 2097151.0;

shared int64_t heights[GROUP_SIZE];
shared ivec4 places[GROUP_SIZE];

struct Support {
    int64_t height;
    ivec3 place;
};

// Keeps the higher one; of equally high ones the lane's own, which is the lower.
void raise(inout Support s, ivec3 d, ivec3 p) {
    int64_t height = heightAlong(d, p);
    bool higher = signOf(height - s.height) > 0;
    s.height = higher ? height : s.height;
    s.place = higher ? p : s.place;
}

Support supportOf(uint fragment, ivec3 d, uint lane) {
    uint c = fragment_list[fragment].x, first = component_start[c], last = component_start[c + 1u];
    Support s = Support(int64_t(-0x3fffffff) * int64_t(0x3fffffff), ivec3(0));
    for (uint k = first + lane; k < last; k += GROUP_SIZE) {
        uvec4 piece = pieces[order[k]];
        raise(s, d, fineOf(positions[piece.x].xyz, fine));
        raise(s, d, fineOf(positions[piece.y].xyz, fine));
        raise(s, d, fineOf(positions[piece.z].xyz, fine));
    }
    heights[lane] = s.height;
    places[lane] = ivec4(s.place, 0);
    barrier();
    for (uint width = ROLLED(GROUP_SIZE / 2u); width > 0u; width >>= 1) {
        if (lane < width && signOf(heights[lane + width] - heights[lane]) > 0) {
            heights[lane] = heights[lane + width];
            places[lane] = places[lane + width];
        }
        barrier();
    }
    s = Support(heights[0], places[0].xyz);
    barrier();
    return s;
}

void writeParting(uint at, uvec2 pair, bool found, ivec3 d, int64_t bound, int64_t other) {
    at *= PARTING_WORDS;
    partings[at] = pair.x;
    partings[at + 1u] = pair.y;
    partings[at + 2u] = found ? 1u : 0u;
    partings[at + 3u] = uint(d.x);
    partings[at + 4u] = uint(d.y);
    partings[at + 5u] = uint(d.z);
    partings[at + 6u] = uint(uint64_t(bound));
    partings[at + 7u] = uint(uint64_t(bound) >> 32);
    partings[at + 8u] = uint(uint64_t(other));
    partings[at + 9u] = uint(uint64_t(other) >> 32);
}

bool partedAlong(ivec3 d, int64_t height, int64_t other, ivec3 site, out int64_t bounds[2]) {
    bounds[0] = boundOf(d, height, site);
    bounds[1] = boundOf(-d, other, site);
    return signOf(bounds[0] + bounds[1]) <= 0;
}

// The first of the fixed directions along which the two lie apart; NO_INDEX where there is none.
uint fixedParting(uvec2 pair, ivec3 site) {
    uint found = NO_INDEX;
    for (uint k = 0u; k < 2u * pairs; k++) {
        int64_t bounds[2];
        int height = supports[pair.x * SUPPORT_DIRECTIONS + k], other = supports[pair.y * SUPPORT_DIRECTIONS + (k ^ 1u)];
        bool parted = partedAlong(8 * supportDirection(k), int64_t(8) * int64_t(height), int64_t(8) * int64_t(other), site, bounds);
        found = parted && found == NO_INDEX ? k : found;
    }
    return found;
}

vec3 middleOf(uint f) {
    uint at = f * SUPPORT_DIRECTIONS;
    return 0.5 * vec3(supports[at] - supports[at + 1u], supports[at + 2u] - supports[at + 3u], supports[at + 4u] - supports[at + 5u]);
}

ivec3 roundedNormal(vec3 v) {
    float size = max(abs(v.x), max(abs(v.y), abs(v.z)));
    return ivec3(roundEven(v * (kLargestNormal / size)));
}

void keepUsed(inout vec3 simplex[4], inout uint count, uint used) {
    uint kept = 0u;
    for (uint k = 0u; k < count; k++) {
        if ((used >> k & 1u) != 0u) simplex[kept++] = simplex[k];
    }
    count = kept;
}

// Loop turns that measuring both once takes.
uint turnsOf(uvec2 pair) {
    uint c = fragment_list[pair.x].x, e = fragment_list[pair.y].x;
    return (component_start[c + 1u] - component_start[c] + component_start[e + 1u] - component_start[e]) / GROUP_SIZE + 96u;
}

// Steps until the difference of the two is seen to lie beyond the origin, or to hold it.
void searchParting(uint at, uvec2 pair, ivec3 site, uint lane) {
    vec3 simplex[4] = vec3[4](vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    vec3 nearest = middleOf(pair.x) - middleOf(pair.y);
    uint count = 0u, steps = min(kMostSteps, MOST_TURNS / turnsOf(pair));
    bool found = false, hopeless = false;
    ivec3 d = ivec3(0);
    int64_t bounds[2] = int64_t[2](int64_t(0), int64_t(0));
    for (uint step = 0u; step < steps && !found && !hopeless; step++) {
        d = nearest == vec3(0.0) ? ivec3(1, 0, 0) : roundedNormal(-nearest);
        Support a = supportOf(pair.x, d, lane), b = supportOf(pair.y, -d, lane);
        found = partedAlong(d, a.height, b.height, site, bounds);
        vec3 corner = vec3(a.place - b.place);
        for (uint k = 0u; k < count; k++) hopeless = hopeless || simplex[k] == corner;
        simplex[min(count, 3u)] = corner;
        count = min(count + 1u, 4u);
        Nearest n = nearestOf(simplex, count);
        hopeless = (hopeless || n.encloses) && !found;
        keepUsed(simplex, count, n.used);
        nearest = n.point;
    }
    if (lane == 0u) writeParting(at, pair, found, d, bounds[0], bounds[1]);
}

void main() {
    uint at = flatGroup(), lane = gl_LocalInvocationID.x;
    if (at >= counts[COUNT_PARTINGS] || counts[STATUS_FAILED] != 0u) return;
    uvec2 pair = island_pairs[parting_list[at]];
    ivec3 site = sites[fragment_list[pair.x].y].xyz;
    uint k = fixedParting(pair, site);
    bool beyond = at - parting_ranges[pair.x].x >= MOST_PARTINGS; // more than cut_colliders looks through
    if (beyond || k != NO_INDEX) {
        int64_t bounds[2];
        uint at_f = pair.x * SUPPORT_DIRECTIONS + min(k, SUPPORT_DIRECTIONS - 1u);
        uint at_g = pair.y * SUPPORT_DIRECTIONS + (min(k, SUPPORT_DIRECTIONS - 1u) ^ 1u);
        ivec3 d = 8 * supportDirection(min(k, SUPPORT_DIRECTIONS - 1u));
        partedAlong(d, int64_t(8) * int64_t(supports[at_f]), int64_t(8) * int64_t(supports[at_g]), site, bounds);
        if (lane == 0u) writeParting(at, pair, !beyond, d, bounds[0], bounds[1]);
        return;
    }
    searchParting(at, pair, site, lane);
}
