// Wants `bodies` declared.
//
// Where a blow acts, of the points of a contact: in the middle of those that meet together. Which of them do is a matter of how far
// apart the others are still: of a rod that comes down askew the lower end is hit, and what stands off by as much as contacts are
// looked for is not. No body is quite stiff: while a blow of some meters a second lasts, for as long as sound takes through a body of
// a meter, it goes on by about as far as this. Less and less counts what comes later, so that the place moves evenly with the tilt.
// What comes slowly, such as the end that a rod stands on while the other one swings down, is not hit with it, but on its own: points
// fall into layers by how fast they come, and the blow is that of the fastest layer, or of a slower one that meets before it, such as
// a corner of a plate that comes down turning, if that breaks something. A ball is hit towards its center, wherever the corners of its
// hull are.
const float kTogether = 5e-4; // m
const float kSlower = 0.5;    // than the fastest point of a layer
const uint kLayers = 4u;

float largestOf(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

// Of the up to four points, from how fast they come closer, m/s; points that are not there come closer by kNoPoint. A layer are those
// that come slower than `limit`, and not much slower than the fastest of them.
const float kNoPoint = -3e38, kNoLimit = 3e38;

float fastestOf(vec4 closings, float limit) { return largestOf(mix(vec4(kNoPoint), closings, lessThan(closings, vec4(limit)))); }
// The first layer is there even if it does not come closer: a ball is not hit at the points that its hull has.
bool isLayer(uint layer, vec4 closings, float limit) { return layer == 0u || fastestOf(closings, limit) > 0.0; }

// Of a layer, from how far apart the points are: weights that sum to one, how far apart the first of those is that count, and the limit
// of the next layer.
vec4 weightsOf(vec4 separations, vec4 closings, inout float limit, out float separation) {
    float fastest = fastestOf(closings, limit), slowest = min(kSlower * fastest, fastest);
    bvec4 is_faster = greaterThanEqual(closings, vec4(limit)), is_fast = greaterThanEqual(closings, vec4(slowest));
    limit = slowest;
    vec4 counting = mix(mix(vec4(3e38), separations, is_fast), vec4(3e38), is_faster);
    separation = -largestOf(-counting);
    vec4 weights = max(1.0 - (counting - separation) / kTogether, 0.0);
    return weights / dot(weights, vec4(1.0));
}

// Whether what is so far apart and comes so fast is well on its way when the other meets.
bool isSooner(float separation, float closing, float other_separation, float other_closing) {
    return other_separation - other_closing * separation / closing > kTogether;
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
