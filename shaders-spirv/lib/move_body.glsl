// A body moves for a substep of h seconds. What contacts did to its spin goes into the angular momentum first, and from it comes the
// spin. Wants `bodies`, `shapes`, `solver_bodies` and `spins` declared.
#include "lib/rigid.glsl"
#include "lib/take_up_spin.glsl"

void moveBody(uint b, float h) {
    SolverBody s = solver_bodies[b];
    vec4 from = bodies[b].turn, turn = turnAfter(s.turned, from);
    mat3 own = ownInverseInertia(shapes[b]);
    vec3 momentum = takeUpSpin(b, own, turn, s.spin.xyz);
    turn = turnFreely(vec3(own[0][0], own[1][1], own[2][2]), turn, momentum, h);
    vec3 spin = spinOf(own, turn, momentum);
    mat3 inverse = worldInertia(own, turn);
    s.moved = vec4(s.moved.xyz + h * s.velocity.xyz, inverse[1][2]);
    s.turned = turnAfter(turn, turnBack(from));
    s.spin = vec4(spin, inverse[2][2]);
    s.inertia = vec4(inverse[0][0], inverse[0][1], inverse[0][2], inverse[1][1]);
    solver_bodies[b] = s;
    spins[b] = vec4(spin, 0.0);
}
