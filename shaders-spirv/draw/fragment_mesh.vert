// A vertex of a fragment: its object's matrix, then the camera. The instance index says which object and which side.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/scene.h"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(set = 0, binding = 0, std430) readonly buffer Matrices { ObjectMatrix matrices[]; };
layout(push_constant) uniform Push { DrawPush push; };

layout(location = 0) out vec3 world_position;
layout(location = 1) out vec3 world_normal;
layout(location = 2) flat out uint instance;

void main() {
    mat4 model = matrices[gl_InstanceIndex / 2].model;
    vec4 world = model * vec4(position, 1.0);
    world_position = world.xyz;
    world_normal = mat3(model) * normal;
    instance = uint(gl_InstanceIndex);
    gl_Position = push.view_projection * world;
}
