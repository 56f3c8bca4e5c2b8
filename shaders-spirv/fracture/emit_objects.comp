// Draw commands (outer, inner), bounds and records of the fragments; a cavity is taken off the piece around it.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/sum.glsl"
#include "shared/fragment_record.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, FragmentRecord, records);
READS(2, uvec2, fates);
READS(3, uvec4, demand_offsets);
READS(4, uvec4, shares);
WRITES(5, uint, draw_commands); // indexCount, instanceCount, firstIndex, vertexOffset, firstInstance
WRITES(6, float, bounds);
WRITES(7, FragmentRecord, fragments);
WRITES(8, mat4, matrices);
WRITES(9, float, objects);      // position, velocity, ... : 24 words, see shared/scene.h
READS(10, uint, ordered_cavities);

void command(uint at, uint count, uint first, uint vertex, uint instance) {
    draw_commands[5u * at] = count;
    draw_commands[5u * at + 1u] = count > 0u ? 1u : 0u;
    draw_commands[5u * at + 2u] = first;
    draw_commands[5u * at + 3u] = vertex;
    draw_commands[5u * at + 4u] = instance;
}

FragmentRecord withoutCavities(uint c, FragmentRecord r) {
    uint total = counts[COUNT_CAVITIES];
    vec4 measure = r.measure, lost_measure = vec4(0.0), moment = r.measure.x * r.balance, lost_moment = vec4(0.0);
    for (uint k = 0u; k < total; k++) {
        uint o = ordered_cavities[k];
        bool ours = fates[o] == uvec2(FATE_CAVITY, c);
        FragmentRecord hollow = records[o];
        addTo(measure, lost_measure, ours ? hollow.measure : vec4(0.0));
        addTo(moment, lost_moment, ours ? hollow.measure.x * hollow.balance : vec4(0.0));
    }
    r.balance = measure.x != r.measure.x ? moment / measure.x : r.balance;
    r.measure = measure;
    return r;
}

void main() {
    uint c = flatIndex();
    if (c >= counts[COUNT_COMPONENTS] || counts[STATUS_FAILED] != 0u) return;
    uvec4 at = demand_offsets[c];
    if (demand_offsets[c + 1u].x == at.x) return;
    uint f = at.x;
    uvec2 sizes = shares[c].zw;
    FragmentRecord r = withoutCavities(c, records[c]);
    command(2u * f, 3u * sizes.x, 3u * at.y, 3u * at.y, 2u * f);
    command(2u * f + 1u, 3u * sizes.y, 3u * (at.y + sizes.x), 3u * at.y, 2u * f + 1u);
    for (uint k = 0u; k < ROLLED(3); k++) {
        bounds[6u * f + k] = r.low[k];
        bounds[6u * f + 3u + k] = r.high[k];
    }
    matrices[f] = mat4(1.0);
    r.range = uvec4(f, at.y, sizes);
    r.fate = uvec4(fates[c], r.fate.zw);
    fragments[f] = r;
    for (uint k = 0u; k < ROLLED(24); k++) objects[24u * f + k] = 0.0;
    for (uint k = 0u; k < ROLLED(3); k++) objects[24u * f + k] = r.balance[k];
}
