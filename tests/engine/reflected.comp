// Something of everything that reflection reports. The second buffer is never touched, yet must keep its place.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "shared/scene.h"

layout(local_size_x = 96) in;
layout(constant_id = 1) const uint kMode = 3;
layout(constant_id = 4) const float kScale = 1.0;
layout(set = 0, binding = 0, std430) readonly buffer Vertices { SceneVertex vertices[]; };
layout(set = 0, binding = 1, std430) buffer Unused { uint unused[]; };
layout(set = 0, binding = 2, std430) writeonly buffer Matrices { ObjectMatrix matrices[]; };
layout(set = 0, binding = 3, std430) buffer Both {
    readonly uint first;
    uint rest[];
};
layout(push_constant) uniform Push {
    uint64_t key;
    uint count;
    float weights[3];
    uint last;
};

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    SceneVertex v = vertices[i];
    matrices[i].model = mat4(v.position[0] * kScale * weights[1]);
    rest[i] = first + kMode + last + uint(key);
}
