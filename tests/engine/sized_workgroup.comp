#version 450
// A workgroup of a size that the host sets: every lane writes how many it sees around it.
layout(local_size_x = 64, local_size_x_id = 100) in;
layout(constant_id = 3) const uint other = 7;
layout(set = 0, binding = 0, std430) writeonly buffer Words { uint words[]; };

void main() { words[gl_GlobalInvocationID.x] = gl_WorkGroupSize.x + 1000u * other; }
