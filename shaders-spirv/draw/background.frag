// A neutral backdrop: lighter towards the top, a little darker in the corners.
#version 450

layout(location = 0) in vec2 place;
layout(location = 0) out vec4 color;

void main() {
    vec3 top = vec3(0.80, 0.82, 0.85), bottom = vec3(0.46, 0.47, 0.49);
    float height = smoothstep(-1.0, 1.0, -place.y);
    float corners = 1.0 - 0.10 * dot(place, place);
    color = vec4(mix(bottom, top, height) * corners, 1.0);
}
