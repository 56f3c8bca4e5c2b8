// What contacts were pressed with is where the next step begins.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"
#include "lib/effect.glsl"
#include "shared/solver.h"

FLAT_KERNEL;
FRICTION_EFFECT;
READS(0, uint, counts);
READS(1, SolverContact, solver_contacts);
UPDATES(2, ContactMemory, memory);
#include "lib/blow.glsl"

void main() {
    uint c = flatIndex();
    if (c >= counts[COUNT_CONTACTS]) return;
    uvec4 ids = solver_contacts[c].ids;
    if (kFriction != 0u) memory[ids.w].rub.xyz = isBlow(c, ids.z) ? vec3(0.0) : solver_contacts[c].rub.xyz;
    memory[ids.w].pace = uvec4(solver_contacts[c].pace.y, 0u, 0u, 0u);
    for (uint k = 0u; k < MANIFOLD_POINTS && k < ids.z; k++) {
        vec4 pulse = solver_contacts[c].points[k].pulse;
        memory[ids.w].anchor_a[k].w = pulse.w >= POINT_HIT ? 0.0 : pulse.x;
        float carried = min(max(memory[ids.w].arm_b[k].w, 0.0), pulse.x);
        memory[ids.w].arm_b[k].w = pulse.w >= POINT_HIT ? HIT_LAST : mix(carried, pulse.x, LOAD_FOLLOWED);
    }
}
