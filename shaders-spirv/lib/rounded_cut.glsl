// The question of lib/exact_cut.glsl, does plane e cut off the corner of planes a, b and c, in floating point: the sign of the same
// determinant. Normals are in units of the grid's edge, which keeps all products within the range of fp32.
#include "lib/precision.glsl"

struct RoundedPlane {
    real3 n;
    real r;
};

const real kGridUnit = real(1.0 / 16777216.0);

// Of a bisector d.w <= d.d, or of a wall as a mirrored site.
RoundedPlane roundedBisector(real3 d) {
    real3 n = d * kGridUnit;
    return RoundedPlane(n, dot(n, n));
}

// Planes in the order in which their normals make a positive volume.
real3 roundedMoment(RoundedPlane a, RoundedPlane b, RoundedPlane c) {
    return a.r * cross(b.n, c.n) + b.r * cross(c.n, a.n) + c.r * cross(a.n, b.n);
}

real roundedVolume(RoundedPlane a, RoundedPlane b, RoundedPlane c) { return dot(a.n, cross(b.n, c.n)); }

bool roundedCuts(RoundedPlane a, RoundedPlane b, RoundedPlane c, RoundedPlane e) {
    return dot(e.n, roundedMoment(a, b, c)) - e.r * roundedVolume(a, b, c) > real(0);
}
