// Impacts, by Newton's law of restitution: a point that comes in with the speed u leaves with the share e of it. Each point of a
// contact presses, or leaves faster than that (a linear complementarity problem, solved by sweeps over the points). So no energy is
// made at any tilt: the impulse of a point times its mean speed is the energy that it adds.
//
// Wants lib/solve_contact.glsl and lib/component.glsl, and `met`, a shared word that becomes 1 where there was an impact.
const uint kPointSweeps = 8u;
const float kAny = 1e30; // m/s

// With what speed the point may come in: what does, and closes its gap within the substep, has to part instead. Others may come in
// as they like: if they meet by what this impact does, that is an impact of its own.
float closingAllowed(SolverPoint p, vec3 normal, float restitution, float lag, Touching t) {
    float separation = separationOf(p, t, normal), speed = speedAt(p, normal, t), comes_in = lag - speed;
    bool meets = comes_in > stiff.w && separation + gravity.w * (speed - 2.0 * lag) <= 0.0;
    // It gains on the way that is left, and loses as much on the way back to here.
    float gains = 4.0 * lag / gravity.w * max(separation, 0.0);
    float leaves = sqrt(max(restitution * restitution * (comes_in * comes_in + gains) - gains, 0.0));
    return meets ? -(leaves + lag) : kAny;
}

float impulseToMeet(float total, SolverPoint p, float allowed, vec3 normal, inout Touching t) {
    float sum = max(total - massAt(p, normal, t) * (speedAt(p, normal, t) + allowed), 0.0);
    pushApart(t, p.arm_a.xyz, p.arm_b.xyz, (sum - total) * normal);
    return sum;
}

// All points that meet at once, if none would have to pull: sweeps alone converge slowly when a face meets a face.
vec4 impulsesTogether(uint c, uint points, SolverPoint p[MANIFOLD_POINTS], vec4 allowed, vec3 normal, bool meets, inout Touching t) {
    vec4 lacks = vec4(0.0);
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++)
        if (k < points && allowed[k] < 0.0) lacks[k] = speedAt(p[k], normal, t) + allowed[k];
    vec4 total = -(pressOf(c) * lacks);
    if (!meets || t.presses_anew || any(lessThan(total, vec4(0.0)))) total = vec4(0.0);
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++)
        if (k < points) pushApart(t, p[k].arm_a.xyz, p[k].arm_b.xyz, total[k] * normal);
    return total;
}

void keepImpact(uint c, uvec4 ids, vec4 normal, vec4 total, Touching t) {
    float pressed = dot(total, vec4(1.0));
    if (pressed == 0.0) return;
    vec4 rub = vec4(0.0);
    if (kFriction != 0u) resistSliding(rub, c, normal.xyz, normal.w * pressed, t);
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++)
        if (k < ids.z) solver_contacts[c].points[k].pulse.y = max(solver_contacts[c].points[k].pulse.y, total[k]);
    keepMotion(ids.x, t.a);
    keepMotion(ids.y, t.b);
    met = 1u;
}

void meetContact(uint c) {
    uvec4 ids = solver_contacts[c].ids;
    vec4 normal = solver_contacts[c].normal;
    float restitution = solver_contacts[c].tangent.w;
    Touching t = touchingOf(c, ids, normal.xyz);
    float lag = 0.5 * gravity.w * approachOf(t.a.inverse_mass > 0.0, t.b.inverse_mass > 0.0, normal.xyz, gravity.xyz);
    SolverPoint p[MANIFOLD_POINTS];
    vec4 allowed = vec4(0.0), total = vec4(0.0);
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++) {
        p[k] = solver_contacts[c].points[k];
        if (k < ids.z) allowed[k] = closingAllowed(p[k], normal.xyz, restitution, lag, t);
    }
    bool meets = restitution > 0.0 && any(lessThan(allowed, vec4(0.0)));
    total = impulsesTogether(c, ids.z, p, allowed, normal.xyz, meets, t);
    for (uint sweep = 0u; sweep < kPointSweeps; sweep++) {
        [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++)
            if (meets && k < ids.z) total[k] = impulseToMeet(total[k], p[k], allowed[k], normal.xyz, t);
    }
    keepImpact(c, ids, normal, total, t);
}
