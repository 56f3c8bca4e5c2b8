// Finds whether any of eight neighboring elements is set, but only if subgroups have eight lanes. Tests use it to show that a
// check at another subgroup size finds such a kernel.
#version 450
#extension GL_KHR_shader_subgroup_vote : require

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Values { uint values[]; };
layout(set = 0, binding = 1, std430) writeonly buffer AnyOfEight { uint any_of_eight[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    any_of_eight[i] = subgroupAny(values[i] != 0u) ? 1u : 0u;
}
