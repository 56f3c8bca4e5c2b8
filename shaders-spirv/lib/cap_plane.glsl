#include "lib/left_turns.glsl"

// Caps are triangulated on whole numbers: the two coordinates that the bisector's normal leaves, in 1/64 grid steps, so that
// the polygon is counter-clockwise seen from the lower cell's outside and every test is exact in 64 bits.
struct CapPlane {
    uint u;
    uint w;
};

CapPlane capPlane(ivec3 qi, ivec3 qj) {
    ivec3 n = qj - qi, size = abs(n);
    uint axis = size.x >= size.y ? (size.x >= size.z ? 0u : 2u) : (size.y >= size.z ? 1u : 2u);
    uint u = (axis + 1u) % 3u, w = (axis + 2u) % 3u;
    return n[axis] < 0 ? CapPlane(w, u) : CapPlane(u, w);
}

int capCoordinate(uint id, uint axis) {
    uint64_t x = uint64_t(points[6u * id + 2u * axis]) | (uint64_t(points[6u * id + 2u * axis + 1u]) << 32);
    return int((x + uint64_t(1u << 17)) >> 18);
}
