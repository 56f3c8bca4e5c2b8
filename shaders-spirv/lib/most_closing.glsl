// How fast any two points of two bodies come closer within a step, at most: along an axis from A to B, or, where that is 0, along any. Wants
// `bodies` and `shapes` declared. `duration_`: of the step, s.
#include "lib/rim_speed.glsl"

float mostClosing(uint a, uint b, vec3 axis, vec3 gravity_, float duration_) {
    vec3 apart = bodies[b].velocity.xyz - bodies[a].velocity.xyz;
    float nearing = axis == vec3(0.0) ? length(apart) : -dot(axis, apart);
    return nearing + duration_ * length(gravity_) + rimSpeed(a) + rimSpeed(b);
}
