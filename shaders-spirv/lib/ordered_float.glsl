// Floats as whole numbers of the same order, for atomics that look for the greatest.
uvec3 orderedBits(vec3 x) {
    uvec3 bits = floatBitsToUint(x);
    return bits ^ mix(uvec3(0x80000000u), uvec3(0xffffffffu), lessThan(x, vec3(0)));
}

vec3 fromOrderedBits(uvec3 ordered) {
    bvec3 negative = lessThan(ordered, uvec3(0x80000000u));
    return uintBitsToFloat(ordered ^ mix(uvec3(0x80000000u), uvec3(0xffffffffu), negative));
}
