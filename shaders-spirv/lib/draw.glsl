// Random numbers, keyed by (seed, site, try) and not by the order of calls, so that every device draws the same. Wants seed_low and
// seed_high declared.
#include "lib/hash.glsl"

uint draw(uint site, uint attempt, uint axis) {
    return mixed(mixed(mixed(mixed(seed_low + 0x9e3779b9u) ^ seed_high) + site * 0x85ebca6bu) ^ (attempt * 4u + axis + 1u));
}

uint below(uint random, uint n) { return uint((uint64_t(random) * uint64_t(n)) >> 32); }
