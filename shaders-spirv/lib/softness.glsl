// A soft constraint (Catto, "Soft Constraints", 2011), for substeps of h seconds: push per overlap, 1/s; shares of the mass and of the
// impulse.

vec3 softnessOf(float hertz, float damping, float h) {
    float omega = 6.2831853 * hertz, a1 = 2.0 * damping + h * omega, a2 = h * omega * a1, a3 = 1.0 / (1.0 + a2);
    return vec3(omega / a1, a2 * a3, a3);
}
