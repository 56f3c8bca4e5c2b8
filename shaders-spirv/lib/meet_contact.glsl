// Impacts, by Newton's law of restitution: a point that comes in with the speed u leaves with the share e of it. Each point of a
// contact presses, or leaves faster than that (a linear complementarity problem, solved by sweeps over the points). So no energy is
// made at any tilt: the impulse of a point times its mean speed is the energy that it adds.
//
// Sweeps go on until impulses hardly change. Of a thin body that falls flat they converge slowly: after eight it had up to 8 % too much
// energy. What is left of that is taken out by giving all impulses a share, with which they add none.
//
// Wants lib/solve_contact.glsl and lib/component.glsl, and `met`, a shared word: the most sweeps that an impact took, 0 without one.
const uint kPointSweeps = 64u;
const float kHardlyChanged = 1e-6; // of the greatest impulse
const float kAny = 1e30;           // m/s, and m
const float kAtOnce = 1e-3;        // of a substep

// Returns the speeds with which the points go apart.
vec4 speedsOf(uint points, SolverPoint p[MANIFOLD_POINTS], vec3 normal, Touching t) {
    vec4 speeds = vec4(0.0);
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++)
        if (k < points) speeds[k] = speedAt(p[k], normal, t);
    return speeds;
}

// Returns what gap of a point is left after the substep if it goes on as it does, and kAny for one that is too slow to bounce.
float gapLeft(float separation, float speed, float lag) {
    return lag - speed > stiff.w ? separation + gravity.w * (speed - 2.0 * lag) : kAny;
}

// With what speed a point that meets may come in: it has to part instead.
float closingAllowed(float separation, float speed, float restitution, float lag) {
    float comes_in = lag - speed;
    // It gains on the way that is left, and loses as much on the way back to here.
    float gains = 4.0 * lag / gravity.w * max(separation, 0.0);
    float leaves = sqrt(max(restitution * restitution * (comes_in * comes_in + gains) - gains, 0.0));
    return -(leaves + lag);
}

// Points that close their gap within the substep have to part. Others may come in as they like: if they meet by what this impact does,
// that is an impact of its own. But corners of a face that comes in flat meet at once, though rounding may have one of them a hair behind.
vec4 closingsAllowed(uint points, SolverPoint p[MANIFOLD_POINTS], vec4 speeds, vec3 normal, float restitution, float lag, Touching t) {
    vec4 separations = vec4(0.0), left = vec4(kAny), allowed = vec4(kAny);
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++) {
        if (k >= points) continue;
        separations[k] = separationOf(p[k], t, normal);
        left[k] = gapLeft(separations[k], speeds[k], lag);
    }
    bool meets = min(min(left.x, left.y), min(left.z, left.w)) <= 0.0;
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++) {
        float behind = kAtOnce * gravity.w * (lag - speeds[k]);
        if (k < points && meets && left[k] <= behind) allowed[k] = closingAllowed(separations[k], speeds[k], restitution, lag);
    }
    return allowed;
}

float impulseToMeet(float total, SolverPoint p, float allowed, vec3 normal, inout Touching t) {
    float sum = max(total - massAt(p, normal, t) * (speedAt(p, normal, t) + allowed), 0.0);
    pushApart(t, p.arm_a.xyz, p.arm_b.xyz, (sum - total) * normal);
    return sum;
}

// All points that meet at once, if none would have to pull: sweeps alone converge slowly when a face meets a face.
vec4 impulsesTogether(uint c, uint points, SolverPoint p[MANIFOLD_POINTS], vec4 speeds, vec4 allowed, vec3 normal, bool meets, inout Touching t) {
    vec4 lacks = vec4(0.0);
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++)
        if (k < points && allowed[k] < 0.0) lacks[k] = speeds[k] + allowed[k];
    vec4 total = -(pressOf(c) * lacks);
    if (!meets || t.presses_anew || any(lessThan(total, vec4(0.0)))) total = vec4(0.0);
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++)
        if (k < points) pushApart(t, p[k].arm_a.xyz, p[k].arm_b.xyz, total[k] * normal);
    return total;
}

// Sweeps over the points; returns how many.
uint meetPoints(uint points, SolverPoint p[MANIFOLD_POINTS], vec4 allowed, vec3 normal, inout vec4 total, inout Touching t) {
    uint sweeps = 0u;
    for (bool open = true; open && sweeps < kPointSweeps; sweeps++) {
        vec4 was = total;
        [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++)
            if (k < points) total[k] = impulseToMeet(total[k], p[k], allowed[k], normal, t);
        vec4 change = abs(total - was);
        open = max(max(change.x, change.y), max(change.z, change.w)) > kHardlyChanged * max(max(total.x, total.y), max(total.z, total.w));
    }
    return sweeps;
}

// An impulse times the mean of the speeds before and after it is the energy that it adds. `before`, `after`: speeds of the points, less
// half of what gravity gives in a substep (lib/approach.glsl).
void addNoEnergy(uint points, SolverPoint p[MANIFOLD_POINTS], vec4 before, vec4 after, vec3 normal, inout vec4 total, inout Touching t) {
    if (dot(total, before + after) <= 0.0) return;
    float share = clamp(-2.0 * dot(total, before) / dot(total, after - before), 0.0, 1.0);
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++)
        if (k < points) pushApart(t, p[k].arm_a.xyz, p[k].arm_b.xyz, (share - 1.0) * total[k] * normal);
    total *= share;
}

void keepImpact(uint c, uvec4 ids, vec4 normal, vec4 total, uint sweeps, Touching t) {
    float pressed = dot(total, vec4(1.0));
    if (pressed == 0.0) return;
    vec4 rub = vec4(0.0);
    if (kFriction != 0u) resistSliding(rub, c, normal.xyz, normal.w * pressed, t);
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++)
        if (k < ids.z) solver_contacts[c].points[k].pulse.y = max(solver_contacts[c].points[k].pulse.y, total[k]);
    keepMotion(ids.x, t.a);
    keepMotion(ids.y, t.b);
    atomicMax(met, sweeps);
}

void meetContact(uint c) {
    uvec4 ids = solver_contacts[c].ids;
    vec4 normal = solver_contacts[c].normal;
    float restitution = solver_contacts[c].tangent.w;
    Touching t = touchingOf(c, ids, normal.xyz);
    float lag = 0.5 * gravity.w * approachOf(t.a.inverse_mass > 0.0, t.b.inverse_mass > 0.0, normal.xyz, gravity.xyz);
    SolverPoint p[MANIFOLD_POINTS];
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++) p[k] = solver_contacts[c].points[k];
    vec4 speeds = speedsOf(ids.z, p, normal.xyz, t);
    vec4 allowed = closingsAllowed(ids.z, p, speeds, normal.xyz, restitution, lag, t);
    bool meets = restitution > 0.0 && any(lessThan(allowed, vec4(0.0)));
    vec4 total = impulsesTogether(c, ids.z, p, speeds, allowed, normal.xyz, meets, t);
    uint sweeps = meets ? meetPoints(ids.z, p, allowed, normal.xyz, total, t) : 0u;
    if (meets) addNoEnergy(ids.z, p, speeds - lag, speedsOf(ids.z, p, normal.xyz, t) - lag, normal.xyz, total, t);
    keepImpact(c, ids, normal, total, sweeps, t);
}
