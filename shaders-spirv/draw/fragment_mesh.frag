// Stone outside, fired clay inside, each fragment a shade of its own; a key light, light from the sky and the ground, and a
// weak light from behind that keeps the dark side readable. Objects may have colors of their own, and fade into the background.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/scene.h"

layout(location = 0) in vec3 world_position;
layout(location = 1) in vec3 world_normal;
layout(location = 2) flat in uint instance;
layout(set = 0, binding = 1, std430) readonly buffer Colors { ObjectColor colors[]; };
layout(push_constant) uniform Push { DrawPush push; };

layout(location = 0) out vec4 color;

float random(uint x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return float((x ^ (x >> 16)) >> 8) / 16777216.0;
}

bool hasOwnColors() { return push.outer_color.w > 0.0; }

vec3 surfaceColor(uint object) {
    bool inner = instance % 2u == uint(SIDE_INNER);
    if (hasOwnColors()) return inner ? colors[object].inner.rgb : colors[object].outer.rgb;
    vec3 base = inner ? push.inner_color.rgb : push.outer_color.rgb;
    float brighter = 2.0 * random(2u * object) - 1.0, warmer = 2.0 * random(2u * object + 1u) - 1.0;
    float tint = push.eye.w;
    return base * (1.0 + tint * brighter) * (vec3(1.0) + 0.5 * tint * warmer * vec3(1.0, 0.0, -1.0));
}

vec3 light(vec3 n) {
    vec3 key = push.key_direction.xyz;
    float lit = max(dot(n, key), 0.0);
    float back = max(dot(n, normalize(vec3(-key.x, 0.25, -key.z))), 0.0);
    vec3 sky = vec3(0.42, 0.45, 0.50), ground = vec3(0.16, 0.14, 0.13);
    vec3 ambient = mix(ground, sky, 0.5 + 0.5 * n.y);
    return push.key_direction.w * (0.95 * lit * vec3(1.0, 0.97, 0.92) + ambient + 0.12 * back);
}

void main() {
    vec3 n = normalize(world_normal);
    vec3 towards_eye = normalize(push.eye.xyz - world_position);
    vec3 halfway = normalize(towards_eye + push.key_direction.xyz);
    float shine = 0.05 * pow(max(dot(n, halfway), 0.0), 24.0);
    uint object = instance / 2u;
    vec3 own = surfaceColor(object), shown = own * light(n) + shine;
    shown /= 1.0 + 0.12 * shown;
    float opaque = 1.0;
    if (hasOwnColors()) {
        shown = mix(own, shown, colors[object].outer.w);
        float end = colors[object].inner.w;
        if (end > 0.0) opaque = 1.0 - smoothstep(0.35 * end, end, distance(push.eye.xyz, world_position));
    }
    color = vec4(shown, opaque);
}
