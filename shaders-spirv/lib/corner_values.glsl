// D_j(v) = |v - q_j|^2 - |v - q_i|^2, exact in 51 bits: positive where v is nearer to i. Affine in v, so that on an edge or
// in a triangle it is fixed by its values at the corners: these values are the only input of every mesh predicate. They fit
// doubles as they are, and fp32 rounds them.
#include "lib/precision.glsl"
#include "lib/wide.glsl"

int64_t cornerValue(ivec3 qi, ivec3 qj, ivec3 v) {
    ivec3 d = qj - qi, s = qj + qi - 2 * v;
    if (kFast) return int64_t(dot(vec3(d), vec3(s)));
    return int64_t(d.x) * int64_t(s.x) + int64_t(d.y) * int64_t(s.y) + int64_t(d.z) * int64_t(s.z);
}

// Ties belong to the lower id, whose weight is the larger one.
bool nearerTo(int64_t dj, uint i, uint j) { return signOf(dj) > 0 || (isZero(dj) && i < j); }
