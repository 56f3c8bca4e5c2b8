// How fast the points of a contact came in when the last substep began. Wants `solver_contacts` declared.
#ifndef BLOW_GLSL
#define BLOW_GLSL
// POINT_HIT, POINT_MET or less: of the fastest point.
float haste(uint c, uint points) {
    float most = 0.0;
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++)
        most = max(most, k < points ? solver_contacts[c].points[k].pulse.w : 0.0);
    return most;
}

// Friction in a blow tells nothing about friction in the next substep.
bool isBlow(uint c, uint points) { return haste(c, points) >= POINT_HIT; }
#endif
