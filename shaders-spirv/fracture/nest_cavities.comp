// The fragment that each cavity belongs to: the smallest piece of its cell that contains it, by the solid angle at one of its
// corners. A workgroup a cavity.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/fragment_record.h"

#define MOST_AROUND 128
GROUP_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, cavities);
READS(2, uint, component_start);
READS(3, uint, order);
READS(4, uvec4, pieces);
READS(5, vec4, positions);
READS(6, FragmentRecord, records);
UPDATES(7, uvec2, fates);
layout(push_constant) uniform Push { float unit; };

shared uint around[MOST_AROUND];
shared uint around_count;
shared float lane_sum[GROUP_SIZE];

vec3 cornerOf(uint id) { return positions[id].xyz * unit; }

// Lists the pieces whose bounds contain the cavity's.
void listAround(uint lane, FragmentRecord mine) {
    if (lane == 0u) around_count = 0u;
    barrier();
    uint total = counts[COUNT_COMPONENTS];
    for (uint o = lane; o < total; o += GROUP_SIZE) {
        FragmentRecord r = records[o];
        bool holds = r.fate.z == mine.fate.z && r.measure.x > 0.0 && all(lessThanEqual(r.low.xyz, mine.low.xyz)) &&
                     all(greaterThanEqual(r.high.xyz, mine.high.xyz));
        uint at = holds ? atomicAdd(around_count, 1u) : MOST_AROUND;
        if (at < MOST_AROUND) around[at] = o;
    }
    barrier();
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

void main() {
    uint lane = gl_LocalInvocationID.x;
    bool idle = counts[STATUS_FAILED] != 0u || flatGroup() >= counts[COUNT_CAVITIES];
    uint cavity = cavities[idle ? 0u : flatGroup()];
    if (idle) return;
    FragmentRecord mine = records[cavity];
    vec3 corner = cornerOf(pieces[order[component_start[cavity]]].x);
    listAround(lane, mine);
    uint total = min(around_count, uint(MOST_AROUND)), best = NO_INDEX;
    float smallest = 3e38;
    for (uint k = 0u; k < total; k++) {
        float volume = records[around[k]].measure.x;
        bool inside = windingAround(lane, around[k], corner) > 0.5;
        bool better = volume < smallest || (volume == smallest && around[k] < best);
        best = inside && better ? around[k] : best;
        smallest = inside && better ? volume : smallest;
    }
    if (lane == 0u) {
        if (best == NO_INDEX || around_count > MOST_AROUND) atomicAdd(counts[STATUS_BAD_UNION], 1u);
        bool gone = best != NO_INDEX && fates[best].x == FATE_DISSOLVED;
        fates[cavity] = uvec2(gone ? FATE_DISSOLVED : FATE_CAVITY, best == NO_INDEX ? cavity : best);
    }
}
