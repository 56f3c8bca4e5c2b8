// Whether any point of a contact was hit in the last substep: what it was rubbed with says nothing about this one. Wants
// `solver_contacts` declared.
#ifndef BLOW_GLSL
#define BLOW_GLSL
bool isBlow(uint c, uint points) {
    bool blow = false;
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++)
        blow = blow || (k < points && solver_contacts[c].points[k].pulse.w >= POINT_HIT);
    return blow;
}
#endif
