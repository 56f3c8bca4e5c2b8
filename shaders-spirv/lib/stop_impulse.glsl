// What slows a body that hangs in another one: where nothing else touches it and the other is much heavier, it comes to move and turn
// as that one does there; half way where the other moves too, since impulse and twist each lower the energy, and so does their
// mean. A body counts in each of its n contacts with an n-th of its mass (mass splitting: Tonge, Benevolenski and Voroshilov 2012),
// so that the energy of all only falls, however many hang in each other. Linear momentum is kept.
// Wants `bodies`, `shapes`, `solver_bodies` and `adjacency_start` declared.
#include "lib/rigid.glsl"
#include "lib/solver_body.glsl"

const float kMostYield = 1e30; // chips are so small that sums of theirs are no floats

StopImpulse noStop() { return StopImpulse(vec4(0.0), vec4(0.0), vec4(0.0)); }

float contactsOf(uint body) { return float(max(adjacency_start[body + 1u] - adjacency_start[body], 1u)); }

// `way`: from the other body to this one.
StopImpulse stopTowards(uint body, uint other, vec3 way, bool is_b) {
    Moving m = movingOf(solver_bodies[body]), o = movingOf(solver_bodies[other]);
    float part = o.inverse_mass > 0.0 ? 0.5 : 1.0, own_count = contactsOf(body), other_count = contactsOf(other);
    vec3 lacks = velocityAt(o, way) - m.velocity, along = lacks / max(length(lacks), 1e-30);
    float yield_ = own_count * m.inverse_mass + other_count * yieldAlong(o, way, along, along);
    vec4 turn = turnAfter(solver_bodies[body].turned, bodies[body].turn);
    mat3 own = ownInverseInertia(shapes[body]);
    vec3 inverse = own_count * vec3(own[0][0], own[1][1], own[2][2]) + other_count * (o.diagonal.x + o.diagonal.y + o.diagonal.z);
    if (!(max(yield_, dot(inverse, vec3(1.0))) < kMostYield)) return noStop();
    vec3 impulse = part / yield_ * lacks;
    vec3 twist = part * turned(turn, turned(turnBack(turn), o.spin - m.spin) / inverse);
    return StopImpulse(vec4(impulse, is_b ? 1.0 : 0.0), vec4(twist, 0.0), vec4(-twist - cross(way, impulse), 0.0));
}
