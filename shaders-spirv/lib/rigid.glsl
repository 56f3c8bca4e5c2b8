// Spin, angular momentum and inertia of a body.
#ifndef RIGID_GLSL
#define RIGID_GLSL
#include "lib/quaternion.glsl"
#include "lib/trigonometry.glsl"
#include "shared/body.h"

// GLSL's matrices are given by columns, these by rows, but they are symmetric.
mat3 ownInverseInertia(BodyShape shape) {
    return mat3(shape.inverse_inertia[0].xyz, shape.inverse_inertia[1].xyz, shape.inverse_inertia[2].xyz);
}

mat3 worldInertia(mat3 own, vec4 turn) {
    mat3 axes = matrixOf(turn);
    return axes * own * transpose(axes);
}

// How much speed along the normal an impulse along it gives at the arm, by turning the body alone.
float turningYield(mat3 inverse_inertia, vec3 arm, vec3 normal) {
    vec3 lever = cross(arm, normal);
    return dot(lever, inverse_inertia * lever);
}

vec3 spinOf(mat3 own_inverse, vec4 turn, vec3 momentum) { return turned(turn, own_inverse * turned(turnBack(turn), momentum)); }

// Turns about one of the own axes. Own components of a vector that stays in the world change to those after the turn.
void turnAbout(vec3 axis, float angle, inout vec4 turn, inout vec3 own) {
    vec2 half_turn = sineAndCosine(0.5 * angle);
    vec4 q = vec4(half_turn.x * axis, half_turn.y);
    turn = turnAfter(turn, q);
    own = turned(turnBack(q), own);
}

// A free body turns so that its angular momentum L stays. Its energy is a sum of parts that are each solved exactly (splitting:
// McLachlan 1993): |L|^2 over the middle moment of inertia turns it about L, what is left turns it about one own axis at a time.
// A top with two equal moments is exact so; of others the energy errs by the square of the step and does not drift. However thin
// a rod is, nothing here divides small differences by its small moment. The own axes are the principal ones.
//
// Turns about own axes by more than a fraction of a radian would set it to a place of another energy: a splinter that a shot sets
// spinning may have a hundred times as much there, with the same momentum. So they are made in parts, and beyond what these can
// do the body keeps its own axes' places about L, as a top does, which costs no energy.
const float kPartOfTurn = 0.25; // rad
const float kMostParts = 128.0;

void turnAboutOwnAxes(vec3 rest, float h, inout vec4 turn, inout vec3 own) {
    const vec3 x = vec3(1.0, 0.0, 0.0), y = vec3(0.0, 1.0, 0.0), z = vec3(0.0, 0.0, 1.0);
    turnAbout(x, 0.5 * h * rest.x * own.x, turn, own);
    turnAbout(y, 0.5 * h * rest.y * own.y, turn, own);
    turnAbout(z, h * rest.z * own.z, turn, own);
    turnAbout(y, 0.5 * h * rest.y * own.y, turn, own);
    turnAbout(x, 0.5 * h * rest.x * own.x, turn, own);
}

vec4 turnFreely(vec3 inverse_moments, vec4 turn, vec3 momentum, float h) {
    float least = min(inverse_moments.x, inverse_moments.y), most = max(inverse_moments.x, inverse_moments.y);
    float middle = max(least, min(most, inverse_moments.z)), size = length(momentum);
    vec3 rest = inverse_moments - middle, own = turned(turnBack(turn), momentum);
    // What each component can come to with this momentum and this energy.
    vec3 most_own = min(vec3(size), sqrt(dot(own * own, inverse_moments) / inverse_moments)), angles = h * abs(rest) * most_own;
    float parts = ceil(max(max(angles.x, angles.y), angles.z) / kPartOfTurn);
    uint count = parts <= kMostParts ? max(uint(parts), 1u) : 0u;
    for (uint k = 0u; k < count; k++) turnAboutOwnAxes(rest, h / float(count), turn, own);
    vec2 half_turn = sineAndCosine(0.5 * h * middle * size);
    vec4 common_ = size > 0.0 ? vec4(half_turn.x / size * momentum, half_turn.y) : vec4(0.0, 0.0, 0.0, 1.0);
    return normalize(turnAfter(common_, turn));
}

#endif
