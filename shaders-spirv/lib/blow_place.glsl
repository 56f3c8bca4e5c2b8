// Wants `bodies` declared.
//
// Where a blow acts, of the points of a contact: in the middle of those that meet together. Which of them do is a matter of how far
// apart the others are still: of a rod that comes down askew the lower end is hit, and what stands off by as much as contacts are
// looked for is not. No body is quite stiff: while a blow of some meters a second lasts, for as long as sound takes through a body of
// a meter, it goes on by about as far as this. Less and less counts what comes later, so that the place moves evenly with the tilt.
// What comes slowly, such as the end that a rod stands on while the other one swings down, is not hit. A ball is hit towards its
// center, wherever the corners of its hull are.
const float kTogether = 5e-4; // m
const float kSlower = 0.5;    // than the fastest point

float largestOf(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

// Of the up to four points, from how far apart they are and how fast they come closer, m/s: weights that sum to one, and how far apart
// the first of those is that count. Points that are not there come closer by kNoPoint.
const float kNoPoint = -3e38;

vec4 weightsOf(vec4 separations, vec4 closings, out float separation) {
    float fastest = largestOf(closings);
    vec4 counting = mix(vec4(3e38), separations, greaterThanEqual(closings, vec4(min(kSlower * fastest, fastest))));
    separation = -largestOf(-counting);
    vec4 weights = max(1.0 - (counting - separation) / kTogether, 0.0);
    return weights / dot(weights, vec4(1.0));
}

// From the point on the hull of a ball to that which would be hit if it were as round as it is meant to be.
vec3 rounding(uint body, vec3 arm, vec3 normal) {
    return (bodies[body].sector.w & BODY_ROUND) != 0 ? dot(arm, normal) * normal - arm : vec3(0.0);
}

// Of two balls each is hit towards its own center.
void roundArms(uvec2 ids, vec3 normal, inout vec3 arm_a, inout vec3 arm_b) {
    vec3 of_a = rounding(ids.x, arm_a, normal), of_b = rounding(ids.y, arm_b, normal);
    arm_a += of_a == vec3(0.0) ? of_b : of_a;
    arm_b += of_b == vec3(0.0) ? of_a : of_b;
}
