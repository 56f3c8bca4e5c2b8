// How fast gravity makes two bodies approach along a normal from A to B: 0 where both fall, or neither.
//
// A substep changes speeds first and places after, so that speeds belong to the middle of the way between two places, half a
// substep behind. Where energy counts they are brought up to the same time.
float approachOf(bool falls_a, bool falls_b, vec3 normal, vec3 gravity_) {
    return dot(gravity_, normal) * ((falls_a ? 1.0 : 0.0) - (falls_b ? 1.0 : 0.0));
}
