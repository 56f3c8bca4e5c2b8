// Principal axes and moments of a solid, from its second moments about its center of mass (Jacobi 1846: two axes at a time are
// turned until their product vanishes, by the smaller angle, so that axes which are principal ones already stay).
//
// Second moments are better to reckon with than moments of inertia: whatever rounding does to them, sums of two of them are
// moments that a solid can have.
#include "lib/double_float.glsl"
#include "lib/quaternion.glsl"

struct Spread {
    vec3 squares;  // xx yy zz
    vec3 products; // yz xz xy: number k is that of the two axes other than k
};

const uint kSweeps = 6u;
const float kRounding = 1e-6; // of second moments, as they are measured: what sums about a corner lose on the way to the center

// A product is nothing where it is no more than rounding makes of two moments this large.
void turnAboutAxis(uint k, inout Spread s, inout vec4 axes) {
    uint i = (k + 1u) % 3u, j = (k + 2u) % 3u;
    float product = s.products[k];
    if (abs(product) <= kRounding * sqrt(max(s.squares[i] * s.squares[j], 0.0))) return;
    float gap = (s.squares[j] - s.squares[i]) / (2.0 * product);
    float tangent = (gap < 0.0 ? -1.0 : 1.0) / (abs(gap) + sqrt(1.0 + gap * gap));
    float cosine = inversesqrt(1.0 + tangent * tangent), sine = tangent * cosine, half_cosine = sqrt(0.5 + 0.5 * cosine);
    s.squares[i] -= tangent * product;
    s.squares[j] += tangent * product;
    s.products[k] = 0.0;
    float by_i = s.products[j], by_j = s.products[i]; // of axis k with either
    s.products[j] = cosine * by_i - sine * by_j;
    s.products[i] = sine * by_i + cosine * by_j;
    vec4 turn = vec4(0.0, 0.0, 0.0, half_cosine);
    turn[k] = -0.5 * sine / half_cosine;
    axes = turnAfter(axes, turn);
}

// From the principal axes into the frame of the moments. They are to be at most about 1.
vec4 principalTurn(Spread s) {
    vec4 axes = vec4(0.0, 0.0, 0.0, 1.0);
    for (uint turn = 0u; turn < 3u * kSweeps; turn++) turnAboutAxis(2u - turn % 3u, s, axes);
    return normalize(axes);
}

Double3 single(vec3 v) { return Double3(v, vec3(0.0)); }

void addMoment(inout Double3 sum, float moment, vec3 a, vec3 b) {
    sum = differenceOf(sum, productOf(productOf(single(a), single(b)), single(vec3(-moment))));
}

// Second moments along the axes, by pairs of floats: of a rod that lies askew the small ones are what is left of large ones.
vec3 momentsAlong(Spread s, vec4 axes) {
    mat3 rows = transpose(matrixOf(axes));
    Double3 sum = single(vec3(0.0));
    for (uint k = 0u; k < 3u; k++) {
        addMoment(sum, s.squares[k], rows[k], rows[k]);
        addMoment(sum, 2.0 * s.products[k], rows[(k + 1u) % 3u], rows[(k + 2u) % 3u]);
    }
    return sum.high + sum.low;
}

// What rounding made less than no solid of that extent along an axis can have, is what a double cone has; only rounding is made
// good for, not what is measured.
vec3 soundMoments(vec3 moments, vec3 extent) {
    float largest = max(max(moments.x, moments.y), moments.z);
    return max(moments, max(min(vec3(kRounding * largest), extent * extent / 40.0), vec3(1e-16)));
}
