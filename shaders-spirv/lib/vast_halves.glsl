// Half-edges of vast faces. Wants vast_diagonals: two corners each, NO_INDEX for absent diagonals.
uint originOf(uint half_) {
    uint side = half_ / VAST_HALVES, part = half_ - VAST_HALVES * side;
    uvec2 diagonal = part == 0u ? uvec2(side) : vast_diagonals[2u * side + (part - 1u) / 2u];
    return (part & 1u) != 0u ? diagonal.x : diagonal.y;
}

bool isSideItself(uint half_) { return half_ % VAST_HALVES == 0u; }

// The other half of a diagonal.
uint twinOf(uint half_) { return (half_ % VAST_HALVES & 1u) != 0u ? half_ + 1u : half_ - 1u; }
