// Counts frames, and the milliseconds that they move on.
#version 450
layout(local_size_x = 1) in;
layout(set = 0, binding = 0, std430) buffer Ticks { uint ticks[]; };
layout(push_constant) uniform Push { uint milliseconds; };

void main() {
    ticks[0] += 1u;
    ticks[1] += milliseconds;
}
