// Sums of two floats, high + low, of about 48 bits (Dekker 1971, Knuth 1969), three at a time.
struct Double3 {
    vec3 high;
    vec3 low;
};

Double3 sumOf(vec3 a, vec3 b) {
    precise vec3 high = a + b;
    precise vec3 part = high - a;
    precise vec3 low = (a - (high - part)) + (b - part);
    return Double3(high, low);
}

Double3 differenceOf(Double3 a, Double3 b) {
    Double3 sum = sumOf(a.high, -b.high);
    precise vec3 low = sum.low + (a.low - b.low);
    return sumOf(sum.high, low);
}

// The upper half of a float's digits.
vec3 upperHalf(vec3 a) {
    precise vec3 shifted = 4097.0 * a;
    precise vec3 high = shifted - (shifted - a);
    return high;
}

Double3 productOf(Double3 a, Double3 b) {
    precise vec3 high = a.high * b.high;
    precise vec3 a1 = upperHalf(a.high), b1 = upperHalf(b.high);
    precise vec3 a2 = a.high - a1, b2 = b.high - b1;
    precise vec3 low = ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2;
    precise vec3 rest = low + (a.high * b.low + a.low * b.high);
    return sumOf(high, rest);
}

Double3 crossOf(Double3 a, Double3 b) {
    return differenceOf(productOf(Double3(a.high.yzx, a.low.yzx), Double3(b.high.zxy, b.low.zxy)),
                        productOf(Double3(a.high.zxy, a.low.zxy), Double3(b.high.yzx, b.low.yzx)));
}
