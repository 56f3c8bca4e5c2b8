// Writes the arguments of an indirect dispatch.
#version 450
layout(local_size_x = 1) in;
layout(set = 0, binding = 0, std430) writeonly buffer Args { uint args[]; };
layout(push_constant) uniform Push { uint groups; };

void main() {
    args[0] = groups;
    args[1] = 1u;
    args[2] = 1u;
}
