// Draw commands (outer; inner with the faces of earlier cuts), bounds and records of the fragments, less their cavities.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/sum.glsl"
#include "shared/fragment_record.h"
#include "shared/scene.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, FragmentRecord, records);
READS(2, uvec2, fates);
READS(3, uvec4, demand_offsets);
READS(4, uvec4, shares);
WRITES(5, DrawCommand, draw_commands); // two a fragment: outer, inner
WRITES(6, Bounds, bounds);
WRITES(7, FragmentRecord, fragments);
WRITES(8, ObjectMatrix, matrices);
WRITES(9, ObjectState, objects);
READS(10, uint, parts); // by owner
READS(11, uint, part_owners);
layout(push_constant) uniform Push { float model_unit; }; // of the records, in model units
#define SORTED part_owners
#define SORTED_COUNT COUNT_PARTS
#include "lib/sorted_list.glsl"

void draw(uint at, uint count, uint first, uint vertex) {
    draw_commands[at] = DrawCommand(count, count > 0u ? 1u : 0u, first, int(vertex), at);
}

// At rest where the model was; what it weighs is for those who know its material.
void placeObject(uint f, vec3 balance) {
    const float zeros3[3] = float[3](0.0, 0.0, 0.0);
    objects[f] = ObjectState(float[3](balance.x, balance.y, balance.z), 0.0, float[4](0.0, 0.0, 0.0, 0.0), zeros3, 0.0, zeros3, 0u,
                             float[6](0.0, 0.0, 0.0, 0.0, 0.0, 0.0), 0u, 0u);
}

// Second moments of a part about another center than its own (Steiner's theorem).
void addMomentsAbout(vec3 center, inout FragmentRecord sum, FragmentRecord part) {
    vec3 d = part.balance.xyz - center;
    sum.squares.xyz += part.squares.xyz + part.measure.x * d * d;
    sum.products.xyz += part.products.xyz + part.measure.x * d.xxy * d.yzz;
}

FragmentRecord withParts(uint c, FragmentRecord r) {
    uint first = firstFrom(c), last = firstFrom(c + 1u);
    vec4 measure = r.measure, lost_measure = vec4(0.0), moment = r.measure.x * r.balance, lost_moment = vec4(0.0);
    for (uint k = first; k < last; k++) {
        FragmentRecord part = records[parts[k]];
        addTo(measure, lost_measure, part.measure);
        addTo(moment, lost_moment, part.measure.x * part.balance);
    }
    r.squares = vec4(0.0);
    r.products = vec4(0.0);
    vec3 balance = measure.x != r.measure.x ? moment.xyz / measure.x : r.balance.xyz;
    addMomentsAbout(balance, r, records[c]);
    for (uint k = first; k < last; k++) addMomentsAbout(balance, r, records[parts[k]]);
    r.balance = vec4(balance, 0.0);
    r.measure = measure;
    return r;
}

void main() {
    uint c = flatIndex();
    if (c >= counts[COUNT_COMPONENTS] || counts[STATUS_FAILED] != 0u) return;
    uvec4 at = demand_offsets[c];
    if (demand_offsets[c + 1u].x == at.x) return;
    uint f = at.x;
    uvec3 sizes = shares[2u * c + 1u].xyz; // own surface, faces of earlier cuts, inner
    FragmentRecord r = withParts(c, records[c]);
    draw(2u * f, 3u * sizes.x, 3u * at.y, 3u * at.y);
    draw(2u * f + 1u, 3u * (sizes.y + sizes.z), 3u * (at.y + sizes.x), 3u * at.y);
    vec3 low = r.low.xyz * model_unit, high = r.high.xyz * model_unit;
    bounds[f] = Bounds(float[3](low.x, low.y, low.z), float[3](high.x, high.y, high.z));
    matrices[f].model = mat4(1.0);
    r.range = uvec4(f, at.y, sizes.x + sizes.y, sizes.z);
    r.fate = uvec4(fates[c], r.fate.z, sizes.y);
    fragments[f] = r;
    placeObject(f, r.balance.xyz * model_unit);
}
