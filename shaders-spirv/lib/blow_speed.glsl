// How fast a point has to come in to be hit by a blow.
//
// The impulse of a blow is forgotten in the next substep, that of a load is not. A load that was forgotten with a blow comes in again
// at the speed that gravity gives to all that it carries. So the limit lies above what gravity gives in a step. Under little
// or no gravity, a part of the shorter arm in a step counts. Both scale with lengths and times alike.
//
// Wants wholeStep(), the seconds of a step, and `gravity` declared.
#ifndef BLOW_SPEED_GLSL
#define BLOW_SPEED_GLSL
#include "shared/solver.h"

float blowSpeed(vec3 arm_a, vec3 arm_b) {
    float arm = sqrt(min(dot(arm_a, arm_a), dot(arm_b, arm_b)));
    return max(BLOW_FALLS * wholeStep() * length(gravity.xyz), min(BLOW_SHARE * arm / wholeStep(), BLOW_SPEED));
}
#endif
