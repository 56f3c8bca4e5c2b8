// Of the way that a body is to go in a step, the share that what is known of its surroundings answers for.
//
// Contacts are found along the straight way that a body has before it when the step begins. What a blow then makes of it, another
// way or a turn, is known only once the step is solved, and may lead through a wall. So bodies that are fast for their size stop
// where they leave that way by more than their thickness (here) or go into what they touch (hold_back); their velocities stay,
// and the rest of the time is lost to them.
//
// A blow bends the way. What comes in aslant stops after the bend, where it touches: on the straight line from where it began to where
// it would have ended it would hang in the air.
#include "lib/turn_by.glsl"
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

vec4 shareOfTurn(vec4 turned_, float share) {
    vec4 shorter = turned_.w < 0.0 ? -turned_ : turned_;
    return normalize(mix(vec4(0.0, 0.0, 0.0, 1.0), shorter, share));
}

// How a body gets on in a step: straight on, and from the bend on straight again.
struct Way {
    vec3 first, second;           // to the bend, and from there
    vec4 turn_first, turn_second; // the same of its turning
    float bend;                   // share of the step; 0: it goes straight all the way
    float share;                  // of the step, after which it has left its way ahead by its thickness; 1 if it does not
};

// When the body changed from the speed of the beginning to that of the end, as a share of the step; 0 where that does not explain its
// way. `after`: its way with the speed of the end.
float bendOf(vec3 moved, vec3 ahead, vec3 after, float thickness) {
    vec3 change = ahead - after;
    float bend = clamp(dot(moved - after, change) / max(dot(change, change), 1e-37), 0.0, 1.0);
    vec3 unexplained = moved - mix(after, ahead, bend);
    return dot(unexplained, unexplained) < 0.0625 * thickness * thickness ? bend : 0.0;
}

// `s`: when the step is solved; velocity and spin: before. `gravity.w`: length of the step.
Way wayOf(SolverBody s, vec3 velocity, vec3 spin, vec4 gravity, float thickness) {
    vec3 ahead = wayAhead(velocity, gravity), moved = s.moved.xyz;
    float along = clamp(dot(moved, ahead) / max(dot(ahead, ahead), 1e-37), 0.0, SWEEP_AHEAD);
    float aside = length(heldUp(moved - along * ahead, gravity));
    float bend = bendOf(moved, ahead, gravity.w * s.velocity.xyz, thickness);
    vec3 first = bend * ahead;
    vec4 turn_first = turnBy(bend * gravity.w * spin);
    float share = aside > thickness ? bend + (1.0 - bend) * thickness / aside : 1.0;
    return Way(first, moved - first, turn_first, turnAfter(s.turned, turnBack(turn_first)), bend, share);
}

// Shares of the way to the bend and of the way from there, after a share of the step.
vec2 sharesOfWay(Way way, float share) {
    return vec2(way.bend > 0.0 ? min(share / way.bend, 1.0) : 1.0, clamp((share - way.bend) / max(1.0 - way.bend, 1e-7), 0.0, 1.0));
}

vec3 placeAt(Way way, float share) {
    vec2 shares = sharesOfWay(way, share);
    return shares.x * way.first + shares.y * way.second;
}

vec4 turnedAt(Way way, float share) {
    vec2 shares = sharesOfWay(way, share);
    return turnAfter(shareOfTurn(way.turn_second, shares.y), shareOfTurn(way.turn_first, shares.x));
}

bool isSwift(float way, float turn, BodyShape shape) { return way + turn * reachOf(shape) > 0.5 * thicknessOf(shape); }
