// Long division of exact integers. Wants lib/wide.glsl.

// floor(2^bits num / den) for |num| < 2^25 den, den > 0, bits < 38.
int64_t quotientOf(Wide128 num, Wide128 den, uint bits) {
    Wide128 shifted = wideShiftLeft25(den), rest = wideAdd(num, shifted);
    uint64_t q = uint64_t(0);
    for (uint k = 0u; k < ROLLED(26u + bits); k++) {
        bool take = !wideLess(rest, shifted);
        if (take) rest = wideSub(rest, shifted);
        rest = wideDouble(rest);
        q = (q << 1) | (take ? uint64_t(1) : uint64_t(0));
    }
    return int64_t(q) - (int64_t(1) << (25u + bits));
}
