// Effective masses and arms of contacts are found when a step begins. Once bodies have turned far enough, they no longer hold.
// Wants `solver_contacts` declared.
#ifndef HAS_TURNED_GLSL
#define HAS_TURNED_GLSL
#include "lib/solver_body.glsl"

float traceOf(SolverBody b) { return b.inertia.x + b.inertia.w + b.spin.w; }

// How far a body has turned, times how unlike its moments of inertia are: 0 for a cube, 1.4 for a rod.
float changeByTurn(SolverBody b) {
    float trace = traceOf(b), per_trace = trace > 0.0 ? 1.0 / trace : 0.0;
    vec3 diagonal = per_trace * vec3(b.inertia.x, b.inertia.w, b.spin.w), side = per_trace * vec3(b.inertia.yz, b.moved.w);
    float unlike = 3.0 * (dot(diagonal, diagonal) + 2.0 * dot(side, side)) - 1.0;
    return unlike > 0.0 ? length(b.turned.xyz) * sqrt(unlike) : 0.0;
}

const float kNoTurn = 1e-3, kHardlyTurned = 0.1, kHardlySlid = 0.05;
const float kTurnSquared = 1.5; // makes about the square of an angle of that of changeByTurn: of a rod 2 would

// The squares of the longest arms of a contact.
vec2 longestArms(uint c, uint points) {
    vec2 longest = vec2(0.0);
    for (uint k = 0u; k < MANIFOLD_POINTS && k < points; k++) {
        vec3 arm_a = solver_contacts[c].points[k].arm_a.xyz, arm_b = solver_contacts[c].points[k].arm_b.xyz;
        longest = max(longest, vec2(dot(arm_a, arm_a), dot(arm_b, arm_b)));
    }
    return longest;
}

// Returns whether turns have changed the effective masses of a contact since the step began. A slender body need not turn far: seen from
// it, its ends move by more than it is thick.
bool hasTurned(uint c, uint points, SolverBody a, SolverBody b) {
    vec2 turns = vec2(changeByTurn(a), changeByTurn(b));
    if (max(turns.x, turns.y) < kNoTurn) return false;
    vec2 moved = kTurnSquared * turns * turns * longestArms(c, points);
    return max(turns.x, turns.y) > kHardlyTurned || dot(moved, vec2(traceOf(a), traceOf(b))) > kHardlySlid * (a.velocity.w + b.velocity.w);
}

#endif
