// The quaternion of a turn.
#ifndef TURN_BY_GLSL
#define TURN_BY_GLSL
#include "lib/quaternion.glsl"
#include "lib/trigonometry.glsl"

// `turn`: along its axis, as long as its angle in rad.
vec4 turnBy(vec3 turn) {
    float angle = length(turn);
    vec2 half_turn = sineAndCosine(0.5 * angle);
    return vec4(half_turn.x / max(angle, 1e-37) * turn, half_turn.y);
}

#endif
