// One contact, solved once: normal impulses of its points; then friction for all points together at their center, and against
// twisting about it.
//
// A point that is still apart may close its gap in this substep and no faster. One that overlaps is pushed out as a damped spring
// would, which takes some of the impulse back as it gives; the solve without push then takes out the speed of that push.
//
// Both bodies are pushed at one and the same point, which stays with the smaller one: the other's arms reach for it wherever the
// bodies have got to. Arms that stay with each body for themselves part as the bodies slide along each other, and the pair turns
// itself: an implosion of 200 hulls lost 1e-3 of its angular momentum, now 1e-7. Where one does not move there is nothing to keep,
// and what slides far on it must not be pushed at a point that it has left: then arms stay with their bodies.
//
// Effective masses are those of the beginning of the step while bodies have hardly turned or slid since. A rod that a blow has set
// spinning yields a hundred times as much in the next substep: an impulse that goes by what it was would add energy without end.
//
// Wants `solver_bodies` and `solver_contacts` declared, and `gravity`, `soft`, `stiff`, `with_push` as in SolverPush. `rubs_in_push`:
// friction acts in the push, too. It lets heaps settle; heavy bodies on light ones would rock. `keeps_first`: contacts keep the
// impulses with which a substep begins.
#include "lib/solver_body.glsl"
#include "lib/approach.glsl"
#include "lib/blow.glsl"
#include "lib/blow_speed.glsl"
#include "lib/effect.glsl"
#include "lib/has_turned.glsl"

FRICTION_EFFECT;

struct Touching {
    Moving a, b;
    vec3 moved;               // of B against A since the step began
    vec3 slid_a, slid_b;      // by how much arms that follow have grown
    vec4 turned_a, turned_b;
    float arms;               // ARMS_*
    bool has_turned;          // so far that arms have to turn, too
    bool presses_anew;        // effective masses along the normal may no longer be those of the beginning
    bool rubs_anew;           // the others
};

float separationOf(SolverPoint p, Touching t, vec3 normal) {
    return p.arm_a.w + dot(normal, t.moved + shifted(t.turned_b, p.arm_b.xyz) - shifted(t.turned_a, p.arm_a.xyz));
}

// Arms of a point as they are now.
struct Arms {
    vec3 a, b;
};

Arms armsNow(Touching t, vec3 arm_a, vec3 arm_b) {
    return Arms(armNow(arm_a, arm_b, t.slid_a, t.turned_a, t.turned_b, t.arms, t.has_turned, false),
                armNow(arm_a, arm_b, t.slid_b, t.turned_a, t.turned_b, t.arms, t.has_turned, true));
}

void pushApart(inout Touching t, vec3 arm_a, vec3 arm_b, vec3 impulse) {
    Arms arms = armsNow(t, arm_a, arm_b);
    push(t.a, -impulse, -cross(arms.a, impulse));
    push(t.b, impulse, cross(arms.b, impulse));
}

vec3 slipAt(Touching t, vec3 arm_a, vec3 arm_b) {
    Arms arms = armsNow(t, arm_a, arm_b);
    return velocityAt(t.b, arms.b) - velocityAt(t.a, arms.a);
}

// Of separation, along the normal.
float speedAt(SolverPoint p, vec3 normal, Touching t) { return dot(normal, slipAt(t, p.arm_a.xyz, p.arm_b.xyz)); }

mat4 pressOf(uint c) {
    return mat4(solver_contacts[c].press[0], solver_contacts[c].press[1], solver_contacts[c].press[2], solver_contacts[c].press[3]);
}

bool pushesNow() { return with_push == PUSH_FIRST || with_push == PUSH_AGAIN; }

// What a point that is so far apart asks for: the speed that it may close with or is pushed with, and the shares of mass and
// impulse that count. A point that pressed before is pushed to where it touches, from either side, and stands still without push: if it
// closed a hair of a gap at once, a body that is jammed in would be thrown there in one substep and back in the next.
vec3 demandOf(float separation, vec4 pulse, vec4 spring) {
    bool is_free = fract(0.5 * pulse.w) != 0.0;
    if (separation > 0.0 && (pulse.x == 0.0 || is_free)) return vec3(separation / gravity.w, 1.0, 0.0);
    return pushesNow() ? vec3(max(spring.x * separation, -spring.w), spring.yz) : vec3(0.0, 1.0, 0.0);
}

float inverseOf(float x) { return x > 0.0 ? 1.0 / x : 0.0; }

// Of what an impulse along v gives along u, at a point.
float yieldBetween(Touching t, vec3 arm_a, vec3 arm_b, vec3 u, vec3 v) {
    Arms arms = armsNow(t, arm_a, arm_b);
    return yieldAlong(t.a, arms.a, u, v) + yieldAlong(t.b, arms.b, u, v);
}

float massAt(SolverPoint p, vec3 normal, Touching t) {
    float now = inverseOf(yieldBetween(t, p.arm_a.xyz, p.arm_b.xyz, normal, normal));
    return t.presses_anew ? now : p.arm_b.w;
}

void solvePoint(inout SolverPoint p, float load, vec3 demand, vec3 normal, inout Touching t) {
    float impulse = -massAt(p, normal, t) * demand.y * (speedAt(p, normal, t) + demand.x) - demand.z * max(p.pulse.x - load, 0.0);
    float total = max(p.pulse.x + impulse, 0.0);
    pushApart(t, p.arm_a.xyz, p.arm_b.xyz, (total - p.pulse.x) * normal);
    p.pulse.x = total;
    p.pulse.y = max(p.pulse.y, total);
}

float freedomOf(SolverPoint p) { return p.pulse.x == 0.0 ? POINT_FREE : POINT_PRESSED; }

// What a point was hit with is no guess for the next substep: applied again there, it would add energy to bodies that turn fast.
void noteBlow(inout SolverPoint p, vec3 normal, Touching t) {
    p.pulse.x = p.pulse.w >= POINT_HIT ? 0.0 : p.pulse.x;
    float comes_in = -speedAt(p, normal, t), blow = blowSpeed(p.arm_a.xyz, p.arm_b.xyz);
    p.pulse.w = freedomOf(p) + (comes_in > blow ? POINT_HIT : comes_in > MEETING_SHARE * blow ? POINT_MET : 0.0);
}

void notePoint(inout SolverPoint p, vec3 normal, Touching t) {
    if (with_push == PUSH_FIRST) noteBlow(p, normal, t);
    if (with_push == RELAX_FIRST) p.pulse.w = freedomOf(p) + 2.0 * floor(0.5 * p.pulse.w);
}

const float kNoPull = 1e-3; // of what all points are pressed with: less is rounding, where impulses are to come to nothing

// All points at once, if none of them would have to pull.
void solveTogether(uint c, inout SolverPoint p[MANIFOLD_POINTS], vec3 demands[MANIFOLD_POINTS], uint points, vec3 normal, inout Touching t) {
    vec4 short_of = vec4(0.0), mass_share = vec4(1.0), impulse_share = vec4(0.0), was = vec4(0.0), loads = solver_contacts[c].loads;
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++) {
        vec3 demand = demands[k];
        float lacks = speedAt(p[k], normal, t) + demand.x;
        // A point that is apart and will stay so is no reason to pull.
        short_of[k] = k < points && (lacks < 0.0 || p[k].pulse.x > 0.0) ? lacks : 0.0;
        was[k] = k < points ? p[k].pulse.x : 0.0; // of points that are none nothing has been written
        mass_share[k] = demand.y;
        impulse_share[k] = demand.z;
    }
    vec4 total = was - mass_share * (pressOf(c) * short_of) - impulse_share * max(was - loads, vec4(0.0));
    // Where a point would have to pull, what the others would be pressed with is too much: that is for the points one by one.
    bool pulls = t.presses_anew || any(lessThan(total, vec4(-kNoPull * dot(was, vec4(1.0)))));
    total = pulls ? was : max(total, vec4(0.0));
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++) {
        if (k < points) pushApart(t, p[k].arm_a.xyz, p[k].arm_b.xyz, (total[k] - was[k]) * normal);
        p[k].pulse.x = k < points ? total[k] : 0.0;
        p[k].pulse.y = max(p[k].pulse.y, p[k].pulse.x);
    }
}

// Together, then there and back again over the points, so that none of them comes first: what is left of the error turns nothing.
void pressContact(uint c, vec3 normal, uint points, vec4 spring, inout Touching t) {
    SolverPoint p[MANIFOLD_POINTS];
    vec3 demands[MANIFOLD_POINTS];
    vec4 first;
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++) {
        p[k] = solver_contacts[c].points[k];
        notePoint(p[k], normal, t);
        demands[k] = demandOf(separationOf(p[k], t, normal), p[k].pulse, spring);
        first[k] = k < points ? p[k].pulse.x : 0.0;
    }
    if (keeps_first && with_push == PUSH_FIRST) solver_contacts[c].first = first;
    solveTogether(c, p, demands, points, normal, t);
    vec4 loads = solver_contacts[c].loads;
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++)
        if (k < points) solvePoint(p[k], loads[k], demands[k], normal, t);
    [[unroll]] for (uint k = MANIFOLD_POINTS; k-- > 0u;)
        if (k < points) solvePoint(p[k], loads[k], demands[k], normal, t);
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++)
        if (k < points) solver_contacts[c].points[k].pulse = p[k].pulse;
}

void resistTwist(inout vec4 rub, vec3 normal, float mass, float most, inout Touching t) {
    float total = clamp(rub.z - mass * dot(normal, t.b.spin - t.a.spin), -most, most);
    float twist = total - rub.z;
    rub.z = total;
    t.a.spin -= spinBy(t.a, twist * normal);
    t.b.spin += spinBy(t.b, twist * normal);
}

vec3 rubMassNow(Touching t, vec3 arm_a, vec3 arm_b, vec3 u, vec3 v) {
    float uu = yieldBetween(t, arm_a, arm_b, u, u), uv = yieldBetween(t, arm_a, arm_b, u, v), vv = yieldBetween(t, arm_a, arm_b, v, v);
    return inverseOf(uu * vv - uv * uv) * vec3(vv, -uv, uu);
}

void resistSliding(inout vec4 rub, uint c, vec3 normal, float most, inout Touching t) {
    vec3 tangent = solver_contacts[c].tangent.xyz, across = cross(normal, tangent);
    vec3 arm_a = solver_contacts[c].center_a.xyz, arm_b = solver_contacts[c].center_b.xyz;
    vec3 mass = t.rubs_anew ? rubMassNow(t, arm_a, arm_b, tangent, across) : solver_contacts[c].rub_mass.xyz;
    vec3 slip = slipAt(t, arm_a, arm_b);
    vec2 speed = vec2(dot(slip, tangent), dot(slip, across));
    vec2 total = rub.xy - vec2(mass.x * speed.x + mass.y * speed.y, mass.y * speed.x + mass.z * speed.y);
    float size = length(total);
    total *= size > most ? most / size : 1.0;
    pushApart(t, arm_a, arm_b, (total.x - rub.x) * tangent + (total.y - rub.y) * across);
    rub.xy = total;
}

void rubContact(uint c, vec4 normal, uint points, inout Touching t) {
    float pressed = 0.0;
    for (uint k = 0u; k < MANIFOLD_POINTS && k < points; k++) pressed += solver_contacts[c].points[k].pulse.x;
    vec4 rub = solver_contacts[c].rub;
    float most = normal.w * pressed;
    float yield_ = dot(normal.xyz, spinBy(t.a, normal.xyz) + spinBy(t.b, normal.xyz));
    float twist_mass = t.rubs_anew ? inverseOf(yield_) : solver_contacts[c].center_a.w;
    resistTwist(rub, normal.xyz, twist_mass, most * solver_contacts[c].center_b.w, t);
    resistSliding(rub, c, normal.xyz, most, t);
    solver_contacts[c].rub = rub;
}

// Whether arms that have grown by so much make effective masses others than when the step began.
bool hasGrown(SolverBody a, SolverBody b, vec3 slid_a, vec3 slid_b) {
    return dot(slid_a, slid_a) * traceOf(a) + dot(slid_b, slid_b) * traceOf(b) > kHardlySlid * (a.velocity.w + b.velocity.w);
}

vec3 beside(vec3 v, vec3 normal) { return v - dot(v, normal) * normal; }

Touching touchingOf(uint c, uvec4 ids, vec3 normal) {
    SolverBody a = solver_bodies[ids.x], b = solver_bodies[ids.y];
    float arms = solver_contacts[c].rub_mass.w;
    vec3 slid_a = followed(a, b, arms, false), slid_b = followed(a, b, arms, true);
    bool has_turned = hasTurned(c, ids.z, a, b);
    return Touching(movingOf(a), movingOf(b), b.moved.xyz - a.moved.xyz, slid_a, slid_b, a.turned, b.turned, arms, has_turned,
                    has_turned || hasGrown(a, b, beside(slid_a, normal), beside(slid_b, normal)),
                    has_turned || hasGrown(a, b, slid_a, slid_b));
}

void keepMotion(uint body, Moving m) {
    if (m.inverse_mass == 0.0) return;
    solver_bodies[body].velocity.xyz = m.velocity;
    solver_bodies[body].spin.xyz = m.spin;
}

// w: the most push, m/s.
vec4 springOf(uint c) {
    return vec4(solver_contacts[c].rub_mass.w == float(ARMS_STAY) ? stiff.xyz : soft.xyz, solver_contacts[c].rub.w);
}

void solveContact(uint c) {
    uvec4 ids = solver_contacts[c].ids;
    vec4 normal = solver_contacts[c].normal;
    Touching t = touchingOf(c, ids, normal.xyz);
    bool after_blow = with_push == PUSH_FIRST && isBlow(c, ids.z); // in the last substep
    pressContact(c, normal.xyz, ids.z, springOf(c), t);
    if (kFriction != 0u && after_blow) solver_contacts[c].rub.xyz = vec3(0.0);
    if (kFriction != 0u && (!pushesNow() || rubs_in_push)) rubContact(c, normal, ids.z, t);
    keepMotion(ids.x, t.a);
    keepMotion(ids.y, t.b);
}

// How much a point lacks of the speed that it should leave with; 0 where it does not bounce.
float lacksOf(SolverPoint p, vec3 normal, float restitution, float lag, Touching t) {
    bool bounces = restitution > 0.0 && p.pulse.z < -stiff.w && p.pulse.y > 0.0;
    return bounces ? speedAt(p, normal, t) + restitution * p.pulse.z - lag : 0.0;
}

// What came in faster than a threshold leaves again with its share of that speed, where it was ever pressed in this step: all
// points at once, or, where one would have to pull, one by one.
void bounceContact(uint c) {
    uvec4 ids = solver_contacts[c].ids;
    vec3 normal = solver_contacts[c].normal.xyz;
    float restitution = solver_contacts[c].tangent.w;
    Touching t = touchingOf(c, ids, normal.xyz);
    float lag = 0.5 * gravity.w * approachOf(t.a.inverse_mass > 0.0, t.b.inverse_mass > 0.0, normal, gravity.xyz);
    vec4 lacks = vec4(0.0), was = vec4(0.0);
    for (uint k = 0u; k < MANIFOLD_POINTS && k < ids.z; k++) {
        SolverPoint p = solver_contacts[c].points[k];
        lacks[k] = lacksOf(p, normal, restitution, lag, t);
        was[k] = p.pulse.x;
    }
    vec4 together = was - pressOf(c) * lacks;
    bool at_once = !t.presses_anew && all(greaterThanEqual(together, vec4(0.0)));
    for (uint k = 0u; k < MANIFOLD_POINTS && k < ids.z; k++) {
        SolverPoint p = solver_contacts[c].points[k];
        float alone = max(was[k] - massAt(p, normal, t) * lacksOf(p, normal, restitution, lag, t), 0.0), total = at_once ? together[k] : alone;
        pushApart(t, p.arm_a.xyz, p.arm_b.xyz, (total - was[k]) * normal);
        solver_contacts[c].points[k].pulse.x = total;
    }
    keepMotion(ids.x, t.a);
    keepMotion(ids.y, t.b);
}
