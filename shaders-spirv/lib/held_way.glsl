// Of the way that a body is to go in a step, the share that what is known of its surroundings answers for.
//
// Contacts are found along the straight way that a body has before it when the step begins. What a blow then makes of it, another
// way or a turn, is known only once the step is solved, and may lead through a wall. So bodies that are fast for their size stop
// where they leave that way by more than their thickness (here) or go into what they touch (hold_back); their velocities stay,
// and the rest of the time is lost to them.
#include "lib/quaternion.glsl"
#include "shared/solver.h"
#include "shared/sweep.h"

float reachOf(BodyShape shape) { return shape.inverse_inertia[2].w; }

// Half the thickness of a body; of plates and slivers more, or they would stop at every touch.
float thicknessOf(BodyShape shape) { return max(uintBitsToFloat(shape.pieces.z), 0.25 * reachOf(shape)); }

vec3 wayAhead(vec3 velocity, vec4 gravity) { return gravity.w * (velocity + gravity.w * gravity.xyz); }

// What lies on a floor does not fall as far as the way ahead has it: that is no way aside.
vec3 heldUp(vec3 aside, vec4 gravity) {
    vec3 fall = gravity.w * gravity.w * gravity.xyz;
    float share = clamp(-dot(aside, fall) / max(dot(fall, fall), 1e-37), 0.0, 1.0);
    return aside + share * fall;
}

// `gravity.w`: length of the step.
float shareOfWay(vec3 moved, vec3 velocity, vec4 gravity, float thickness) {
    vec3 ahead = wayAhead(velocity, gravity);
    float along = clamp(dot(moved, ahead) / max(dot(ahead, ahead), 1e-37), 0.0, SWEEP_AHEAD);
    float aside = length(heldUp(moved - along * ahead, gravity));
    return aside > thickness ? thickness / aside : 1.0;
}

vec4 shareOfTurn(vec4 turned_, float share) {
    vec4 shorter = turned_.w < 0.0 ? -turned_ : turned_;
    return normalize(mix(vec4(0.0, 0.0, 0.0, 1.0), shorter, share));
}

bool isSwift(float way, float turn, BodyShape shape) { return way + turn * reachOf(shape) > 0.5 * thicknessOf(shape); }
