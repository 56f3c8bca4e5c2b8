// How fast gravity makes two bodies approach along a normal from A to B: 0 where both fall.
//
// A substep changes speeds first and places after, so that speeds belong to the middle of the way between two places, half a
// substep behind. Where energy counts they are brought up to the same time.
float approachOf(float inverse_mass_a, float inverse_mass_b, vec3 normal, vec3 gravity_) {
    return dot(gravity_, normal) * ((inverse_mass_a > 0.0 ? 1.0 : 0.0) - (inverse_mass_b > 0.0 ? 1.0 : 0.0));
}
