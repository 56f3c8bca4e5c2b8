// How much crack each object has got, a workgroup an object: half of the new faces of its fragments, since each cut has two
// sides. Sums in the order of fragments, by lanes that are always as many. What the blow cannot pay for does not break: cells of
// a few sites may have more faces between them than the law of counts expects, and other contacts of the two that met may have
// stopped them. And how much of each is too small to be a body, and how large what is not.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/smallest_piece.glsl"
#include "lib/sum.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/fragment_record.h"
#include "shared/material.h"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, BreakingRecord, breaking);
READS(2, BrokenBody, broken);
READS(3, BreakableBody, breakable);
READS(4, MaterialCard, cards);
READS(5, uint, owners); // sorted
READS(6, uint, order);
READS(7, FragmentRecord, fragments);
WRITES(8, float, cracks); // m2; below 0 where the blow cannot pay for it, 0 where there is one piece
WRITES(9, uint, owner_start);
WRITES(10, SizeShare, sizes);
READS(11, BodyState, bodies);
READS(12, BodyShape, shapes);
layout(push_constant) uniform Push { float least_volume; }; // m3, of a body
#define SORTED owners
#define SORTED_COUNT COUNT_FRAGMENTS
#include "lib/sorted_list.glsl"
#include "lib/blow_now.glsl"

shared vec3 sums[GROUP_SIZE]; // of faces, of dust: volume and cells
shared vec2 ends[GROUP_SIZE]; // the largest and the smallest volume of what is no dust

// Of what the two have left, where both break half for each. What is struck by hand is paid for by the hand.
float joulesLeftFor(uint k) {
    if (broken[k].ids.y == NO_INDEX) return broken[k].share.x;
    float left = energyOf(blowNow(struckBy(k), striking(k), broken[k].along.xyz));
    return min(broken[k].share.x, partnerOf(k) != NO_INDEX ? 0.5 * left : left);
}

bool isAffordable(uint k, float area) { return cards[breakable[broken[k].ids.x].surface.w].cracks.y * area <= joulesLeftFor(k); }

// In units of half a grid's edge.
vec3 sumOf(uint first, uint last, uint lane, float scale) {
    vec4 sum = vec4(0.0), lost = vec4(0.0);
    for (uint r = first + lane; r < last; r += GROUP_SIZE) {
        vec4 measure = fragments[order[r]].measure;
        float small = isTooSmall(measure.x, scale, least_volume) ? 1.0 : 0.0;
        addTo(sum, lost, vec4(measure.y - measure.z, small * measure.x, small, 0.0));
    }
    return sum.xyz;
}

vec2 endsOf(uint first, uint last, uint lane, float scale) {
    vec2 found = vec2(0.0, 3e38);
    for (uint r = first + lane; r < last; r += GROUP_SIZE) {
        float volume = fragments[order[r]].measure.x;
        if (!isTooSmall(volume, scale, least_volume)) found = vec2(max(found.x, volume), min(found.y, volume));
    }
    return found;
}

void main() {
    uint k = flatGroup(), lane = gl_LocalInvocationID.x;
    if (k >= counts[COUNT_BREAKING]) return;
    uint first = firstFrom(k), last = firstFrom(k + 1u);
    sums[lane] = sumOf(first, last, lane, breaking[k].center.w);
    ends[lane] = endsOf(first, last, lane, breaking[k].center.w);
    barrier();
    if (lane != 0u) return;
    vec3 total = vec3(0.0);
    vec2 found = ends[0];
    for (uint j = 0u; j < GROUP_SIZE; j++) {
        total += sums[j];
        found = vec2(max(found.x, ends[j].x), min(found.y, ends[j].y));
    }
    float unit = 1.0 / breaking[k].center.w, area = 0.5 * total.x * unit * unit;
    cracks[k] = isAffordable(k, area) ? area : -area;
    sizes[k] = SizeShare(total.y * unit * unit * unit, total.z, found.x * unit * unit * unit, min(found.x, found.y) * unit * unit * unit);
    owner_start[k] = first;
    if (k + 1u == counts[COUNT_BREAKING]) owner_start[k + 1u] = last;
}
