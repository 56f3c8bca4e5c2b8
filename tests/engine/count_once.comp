// One lane per workgroup adds one to the element of its flat index; indices past the end add to the last element.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/dispatch.glsl"

layout(local_size_x = 1) in;
layout(set = 0, binding = 0, std430) buffer Visits { uint visits[]; };
layout(push_constant) uniform Push { uint count; };

void main() { atomicAdd(visits[min(flatIndex(), count)], 1u); }
