// A cell while the exact kernel cuts it: planes, and corners as triples of planes in the order in which their normals make a
// positive volume. In shared memory, or for the larger kernels in a buffer, a store a workgroup.
// Slots of corners that are gone are taken again before new ones are.
#include "lib/filter_bounds.glsl"
#include "lib/rounded_cut.glsl"

#ifdef GLOBAL_STORE
struct CellStore {
    ivec4 plane_d[PLANES];
    vec4 corner_place[CORNERS];
    uvec2 plane_r[PLANES];
    uvec2 corner_planes[CORNERS];
    int rim_sum[PLANES];
    int rim_squares[PLANES];
    uint slots[CORNERS];
    uint corner_store[16 * CORNERS];
};
layout(set = 0, binding = 7, std430) coherent buffer stores_block { CellStore stores[]; };
#define plane_d stores[flatGroup()].plane_d
#define corner_place stores[flatGroup()].corner_place
#define plane_r stores[flatGroup()].plane_r
#define corner_planes stores[flatGroup()].corner_planes
#define rim_sum stores[flatGroup()].rim_sum
#define rim_squares stores[flatGroup()].rim_squares
#define slots stores[flatGroup()].slots
#define corner_store stores[flatGroup()].corner_store
#else
shared ivec4 plane_d[PLANES];        // normal, id
shared vec4 corner_place[CORNERS];   // w in fp32 and a bound of its error
shared uvec2 plane_r[PLANES];
shared uvec2 corner_planes[CORNERS]; // a | b << 16, c | GONE
shared int rim_sum[PLANES];
shared int rim_squares[PLANES];
shared uint slots[CORNERS];          // corners in question, then free ones
shared uint corner_store[16 * CORNERS]; // moment and volume
#endif

#define GONE 0x80000000u

void sync() {
#ifdef GLOBAL_STORE
    memoryBarrierBuffer();
#endif
    barrier();
}

uint loadWord(uint t, uint k) { return corner_store[k * CORNERS + t]; }
void saveWord(uint t, uint k, uint v) { corner_store[k * CORNERS + t] = v; }

Wide128 loadWide(uint t, uint k) {
    uint64_t lo = uint64_t(loadWord(t, k)) | (uint64_t(loadWord(t, k + 1u)) << 32);
    uint64_t hi = uint64_t(loadWord(t, k + 2u)) | (uint64_t(loadWord(t, k + 3u)) << 32);
    return Wide128(lo, int64_t(hi));
}

void saveWide(uint t, uint k, Wide128 v) {
    saveWord(t, k, uint(v.lo));
    saveWord(t, k + 1u, uint(v.lo >> 32));
    saveWord(t, k + 2u, uint(uint64_t(v.hi)));
    saveWord(t, k + 3u, uint(uint64_t(v.hi) >> 32));
}

Corner loadCorner(uint t) {
    Corner c;
    c.moment[0] = loadWide(t, 0u);
    c.moment[1] = loadWide(t, 4u);
    c.moment[2] = loadWide(t, 8u);
    c.volume = loadWide(t, 12u);
    return c;
}

Plane planeAt(uint p) {
    ivec4 d = plane_d[p];
    uvec2 r = plane_r[p];
    return Plane(d.xyz, uint(d.w), int64_t(uint64_t(r.x) | (uint64_t(r.y) << 32)));
}

void setPlane(uint p, Plane plane) {
    plane_d[p] = ivec4(plane.d, int(plane.id));
    plane_r[p] = uvec2(uint(uint64_t(plane.r)), uint(uint64_t(plane.r) >> 32));
}

RoundedPlane roundedPlaneAt(uint p) {
    Plane plane = planeAt(p);
    if (plane.id < BOX_BASE) return roundedBisector(real3(plane.d));
    return RoundedPlane(real3(plane.d), real(plane.r) * kGridUnit);
}

void makeRoundedCorner(uint t, uint p, uint q, uint r) {
    RoundedPlane a = roundedPlaneAt(p), b = roundedPlaneAt(q), c = roundedPlaneAt(r);
    vec3 w = vec3(roundedMoment(a, b, c) / (roundedVolume(a, b, c) * kGridUnit));
    corner_planes[t] = uvec2(p | (q << 16), r);
    corner_place[t] = vec4(w, kPlaceError * sumOfSizes(w));
}

void makeCorner(uint t, uint a, uint b, uint c) {
    if (!kExact) {
        makeRoundedCorner(t, a, b, c);
        return;
    }
    Corner corner = cornerOf(planeAt(a), planeAt(b), planeAt(c));
    corner_planes[t] = uvec2(a | (b << 16), c);
    saveWide(t, 0u, corner.moment[0]);
    saveWide(t, 4u, corner.moment[1]);
    saveWide(t, 8u, corner.moment[2]);
    saveWide(t, 12u, corner.volume);
    vec3 w = placeOf(corner);
    corner_place[t] = vec4(w, kPlaceError * sumOfSizes(w));
}
