// What becomes of each component. Thinner than about two grid steps: dissolved, and what faced it becomes outer surface (its
// volume is rounding, and may even come out negative). Turned inside out: a cavity of the smallest piece of its cell that
// contains it, by the solid angle at one of its corners. Everything else is a fragment.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/fragment_record.h"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, component_start);
READS(2, uint, order);
READS(3, uvec4, pieces);
READS(4, vec4, positions);
READS(5, FragmentRecord, records);
WRITES(6, uvec2, fates); // fate, the component it belongs to
layout(push_constant) uniform Push { float step_size; };

bool isTiny(FragmentRecord r) {
    float thin = r.measure.y * step_size + r.measure.w * step_size * step_size;
    return r.measure.x <= thin && (r.measure.x >= -thin || r.measure.z < 0.9 * r.measure.y);
}

float windingAround(uint component, vec3 p) {
    float sum = 0.0;
    uint last = component_start[component + 1u];
    for (uint k = component_start[component]; k < last; k++) {
        uvec4 piece = pieces[order[k]];
        vec3 a = positions[piece.x].xyz - p, b = positions[piece.y].xyz - p, c = positions[piece.z].xyz - p;
        float la = length(a), lb = length(b), lc = length(c);
        sum += 2.0 * atan(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return sum / (4.0 * 3.14159265);
}

void main() {
    uint c = flatIndex();
    if (c >= counts[COUNT_COMPONENTS] || counts[STATUS_FAILED] != 0u) return;
    FragmentRecord mine = records[c];
    bool tiny = isTiny(mine), cavity = !tiny && mine.measure.x < 0.0;
    uint around = NO_INDEX, others = cavity ? counts[COUNT_COMPONENTS] : 0u;
    float smallest = 3e38;
    vec3 corner = positions[pieces[order[component_start[c]]].x].xyz;
    for (uint o = 0u; o < others; o++) {
        FragmentRecord r = records[o];
        bool holds = r.fate.z == mine.fate.z && r.measure.x > 0.0 && r.measure.x < smallest &&
                     all(lessThanEqual(r.low.xyz, mine.low.xyz)) && all(greaterThanEqual(r.high.xyz, mine.high.xyz));
        if (holds && windingAround(o, corner) > 0.5) {
            around = o;
            smallest = r.measure.x;
        }
    }
    if (tiny) atomicAdd(counts[STATUS_DISSOLVED], 1u);
    if (cavity) atomicAdd(counts[STATUS_CAVITIES], 1u);
    if (cavity && around == NO_INDEX) atomicAdd(counts[STATUS_BAD_UNION], 1u);
    uint fate = tiny ? FATE_DISSOLVED : (cavity ? FATE_CAVITY : FATE_FRAGMENT);
    fates[c] = uvec2(fate, cavity && around != NO_INDEX ? around : c);
}
