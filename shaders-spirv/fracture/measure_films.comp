// The volume of films anew, a workgroup a film: what is as thin as a float's last digit needs twice the digits for its sign.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/double_float.glsl"
#include "shared/fragment_record.h"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, uint, films);
READS(2, uint, component_start);
READS(3, uint, order);
READS(4, uvec4, pieces);
READS(5, vec4, positions);
UPDATES(6, FragmentRecord, records);
layout(push_constant) uniform Push { float unit; };

shared vec2 sums[GROUP_SIZE];

Double3 cornerFrom(uint id, vec3 origin) { return sumOf(positions[id].xyz * unit, -origin); }

vec2 added(vec2 a, vec2 b) {
    Double3 sum = sumOf(vec3(a.x), vec3(b.x));
    precise float low = sum.low.x + (a.y + b.y);
    return vec2(sum.high.x, low);
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    bool idle = counts[STATUS_FAILED] != 0u || flatGroup() >= counts[COUNT_FILMS];
    uint c = idle ? 0u : films[flatGroup()], first = idle ? 0u : component_start[c], last = idle ? 0u : component_start[c + 1u];
    vec3 origin = positions[pieces[order[first]].x].xyz * unit;
    vec2 six_volumes = vec2(0.0);
    for (uint k = first + lane; k < last; k += GROUP_SIZE) {
        uvec4 piece = pieces[order[k]];
        Double3 a = cornerFrom(piece.x, origin);
        Double3 normal = crossOf(cornerFrom(piece.y, origin), cornerFrom(piece.z, origin));
        Double3 part = productOf(a, normal);
        for (uint axis = 0u; axis < ROLLED(3); axis++) six_volumes = added(six_volumes, vec2(part.high[axis], part.low[axis]));
    }
    sums[lane] = six_volumes;
    barrier();
    for (uint width = ROLLED(GROUP_SIZE / 2u); width > 0u; width >>= 1) {
        if (lane < width) sums[lane] = added(sums[lane], sums[lane + width]);
        barrier();
    }
    if (lane == 0u && !idle) records[c].measure.x = (sums[0].x + sums[0].y) / 6.0;
}
