// Angular momentum is the state of a body, spin what the solver changes: what it changed since `spins` was written goes into the
// momentum. Nothing changed leaves the momentum as it is, bit for bit. Wants `bodies` and `spins` declared, and lib/rigid.glsl.
vec3 takeUpSpin(uint body, mat3 own_inverse, vec4 turn, vec3 spin) {
    vec3 gained = spin - spins[body].xyz;
    vec3 own = inverse(own_inverse) * turned(turnBack(turn), gained);
    vec3 momentum = bodies[body].momentum.xyz + turned(turn, own);
    bodies[body].momentum.xyz = momentum;
    return momentum;
}
