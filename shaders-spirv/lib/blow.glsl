// Whether any point of a contact was hit in the last substep, so that its impulses are no guess for this one. Wants
// `solver_contacts` declared.
bool isBlow(uint c, uint points) {
    bool blow = false;
    for (uint k = 0u; k < MANIFOLD_POINTS && k < points; k++) blow = blow || solver_contacts[c].points[k].pulse.w != 0.0;
    return blow;
}
