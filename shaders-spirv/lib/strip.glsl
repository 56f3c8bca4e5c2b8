// How wide a strip is by which hulls overlap that only graze each other.
#ifndef STRIP_GLSL
#define STRIP_GLSL

const float kThinStrip = 0.05, kFlatStrip = 1e-4; // of the smaller radius: as wide as a strip may be, and always is

// Returns meters, and 0 if there is no gravity. `wanted`: the strip of the push constants.
float stripBetween(float wanted, float smaller) {
    return wanted > 0.0 ? clamp(wanted, kFlatStrip * smaller, kThinStrip * smaller) : 0.0;
}

#endif
