// Two bodies of a remembered contact as they are when the step begins: where its points have got to, and how fast they will meet.
// Wants `memory`, `bodies` and `solver_bodies` declared.
#include "lib/approach.glsl"
#include "lib/body_way.glsl"
#include "lib/solver_body.glsl"

struct Pair {
    Moving a, b;
    vec4 turn_a, turn_b;
    vec3 way, came; // from A to B, and what of that since the points were found
    vec3 slid_a, slid_b; // of arms that follow, since the points were found
    bvec2 falls;
};

// What lies on others is carried by them until it is hit.
bool falls(uint body) { return solver_bodies[body].velocity.w > 0.0 && (bodies[body].sector.w & BODY_BORNE) == 0; }

Pair pairNow(uint pair, uvec4 ids) {
    Pair p = Pair(movingOf(solver_bodies[ids.x]), movingOf(solver_bodies[ids.y]), bodies[ids.x].turn, bodies[ids.y].turn,
                  wayBetween(ids.x, ids.y), vec3(0.0), vec3(0.0), vec3(0.0), bvec2(falls(ids.x), falls(ids.y)));
    p.came = p.way - turned(memory[pair].turn_a, memory[pair].place.xyz);
    return p;
}

vec3 armOfA(uint pair, uint k, Pair p) { return turned(p.turn_a, memory[pair].anchor_a[k].xyz); }
vec3 armOfB(uint pair, uint k, Pair p) { return turned(p.turn_b, memory[pair].anchor_b[k].xyz); }

float partingAt(Pair p, vec3 arm_a, vec3 arm_b, vec3 normal) { return dot(normal, velocityAt(p.b, arm_b) - velocityAt(p.a, arm_a)); }

// By differences: how far it is to the place of an endless plane says nothing.
float separationNow(uint pair, uint k, Pair p, vec3 normal) {
    vec3 left_a = armOfA(pair, k, p) - memory[pair].arm_a[k].xyz, left_b = armOfB(pair, k, p) - memory[pair].arm_b[k].xyz;
    return memory[pair].arm_a[k].w + dot(normal, p.came + left_b - left_a);
}

// What falls until it hits comes in faster than it is now: by the energy of the way that is left, and by half a substep, since
// speeds lag places by as much (lib/approach.glsl). `gravity_.w`: length of a substep.
float speedOfMeeting(float speed, float separation, Pair p, vec3 normal, vec4 gravity_) {
    float gain = approachOf(p.falls.x, p.falls.y, normal, gravity_.xyz), now = speed - 0.5 * gravity_.w * gain;
    return speed < 0.0 ? -sqrt(max(now * now + 2.0 * gain * max(separation, 0.0), 0.0)) : speed;
}
