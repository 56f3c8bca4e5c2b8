// A workgroup of two dimensions, which the engine refuses.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, std430) buffer Words { uint words[]; };

void main() { words[gl_LocalInvocationIndex] = 0u; }
