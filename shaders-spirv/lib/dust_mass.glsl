// Masses of particles as whole numbers of grains, and their sums. Wants `state` declared, and shared/dust.h.

// Low and high word. A mass is a float, so that nothing is cut off but what is less than a grain.
uvec2 grainsOf(float mass) {
    float high = floor(ldexp(mass, DUST_GRAIN_BITS - 32));
    return uvec2(uint(ldexp(mass - ldexp(high, 32 - DUST_GRAIN_BITS), DUST_GRAIN_BITS)), uint(high));
}

// The mass without what is less than a grain.
float wholeGrains(float mass) {
    uvec2 grains = grainsOf(mass);
    return ldexp(float(grains.y), 32 - DUST_GRAIN_BITS) + ldexp(float(grains.x), -DUST_GRAIN_BITS);
}

// Whoever makes the low word pass its end carries: the sum is the same in whatever order.
void addMass(uint word, float mass) {
    uvec2 grains = grainsOf(mass);
    uint was = atomicAdd(state[word], grains.x);
    uint carry = was + grains.x < was ? 1u : 0u;
    if (grains.y + carry != 0u) atomicAdd(state[word + 1u], grains.y + carry);
}
