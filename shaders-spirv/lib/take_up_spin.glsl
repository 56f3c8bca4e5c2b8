// Angular momentum is the state of a body, spin what the solver changes: what it changed since `spins` was written goes into the
// momentum. Nothing changed leaves the momentum as it is, bit for bit. Wants `bodies` and `spins` declared, and lib/rigid.glsl.

// Of any size: the determinant of an inertia of 1e13 kg m2, inverted, is no float. Powers of two round nothing.
mat3 inertiaOf(mat3 own_inverse) {
    float trace = own_inverse[0][0] + own_inverse[1][1] + own_inverse[2][2];
    float unit = uintBitsToFloat(floatBitsToUint(trace) & 0x7f800000u), per_unit = unit > 0.0 ? 1.0 / unit : 0.0;
    return inverse(own_inverse * per_unit) * per_unit;
}

vec3 takeUpSpin(uint body, mat3 own_inverse, vec4 turn, vec3 spin) {
    vec3 gained = spin - spins[body].xyz;
    vec3 own = inertiaOf(own_inverse) * turned(turnBack(turn), gained);
    vec3 momentum = bodies[body].momentum.xyz + turned(turn, own);
    bodies[body].momentum.xyz = momentum;
    return momentum;
}
