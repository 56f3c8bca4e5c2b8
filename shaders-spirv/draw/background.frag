// A neutral backdrop: lighter towards the top, a little darker in the corners.
#version 450

layout(location = 0) in vec2 place;
layout(location = 0) out vec4 color;

// Half a step of an 8-bit channel, at random: hides the bands of a slow gradient.
float grain() { return fract(sin(dot(gl_FragCoord.xy, vec2(12.9898, 78.233))) * 43758.5453) - 0.5; }

void main() {
    vec3 top = vec3(0.60, 0.63, 0.67), bottom = vec3(0.27, 0.28, 0.30);
    float height = smoothstep(-1.0, 1.0, -place.y);
    float corners = 1.0 - 0.10 * dot(place, place);
    color = vec4(mix(bottom, top, height) * corners + 0.012 * grain(), 1.0);
}
