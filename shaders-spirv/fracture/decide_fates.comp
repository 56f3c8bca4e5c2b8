// What becomes of each component. Thinner than about two grid steps: dissolved, and what faced it becomes outer surface (its
// volume is rounding, and may even come out negative). Turned inside out: a cavity, listed for nest_cavities. Everything else
// is a fragment.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/fragment_record.h"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, FragmentRecord, records);
WRITES(2, uvec2, fates);
WRITES(3, uint, cavities);
layout(push_constant) uniform Push { float step_size; };

bool isTiny(FragmentRecord r) {
    float thin = r.measure.y * step_size + r.measure.w * step_size * step_size;
    return r.measure.x <= thin && (r.measure.x >= -thin || r.measure.z < 0.9 * r.measure.y);
}

void main() {
    uint c = flatIndex();
    if (c >= counts[COUNT_COMPONENTS] || counts[STATUS_FAILED] != 0u) return;
    FragmentRecord mine = records[c];
    bool tiny = isTiny(mine), cavity = !tiny && mine.measure.x < 0.0;
    if (tiny) atomicAdd(counts[STATUS_DISSOLVED], 1u);
    if (cavity) cavities[atomicAdd(counts[COUNT_CAVITIES], 1u)] = c;
    fates[c] = uvec2(tiny ? FATE_DISSOLVED : (cavity ? FATE_CAVITY : FATE_FRAGMENT), c);
}
