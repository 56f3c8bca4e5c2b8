// The directions in which fragments are measured, a pair of opposite ones a row: axes, corners, edges of a cube, and 36 in
// the gaps between these. Each set holds the smaller ones, so that more directions do not make a collider looser. What lies
// between them is at most 55 degrees from one of 6, 37 from one of 14, 28 of 26, 19 of 62.
const ivec3 kDirections[31] = ivec3[31](
    ivec3(1, 0, 0), ivec3(0, 1, 0), ivec3(0, 0, 1),
    ivec3(1, 1, 1), ivec3(1, 1, -1), ivec3(1, -1, 1), ivec3(-1, 1, 1),
    ivec3(0, 1, 1), ivec3(0, 1, -1), ivec3(1, 0, 1), ivec3(-1, 0, 1), ivec3(1, 1, 0), ivec3(1, -1, 0),
    ivec3(3, 1, 1), ivec3(3, 1, -1), ivec3(3, -1, 1), ivec3(-3, 1, 1),
    ivec3(1, 3, 1), ivec3(1, 3, -1), ivec3(1, -3, 1), ivec3(-1, 3, 1),
    ivec3(1, 1, 3), ivec3(1, 1, -3), ivec3(1, -1, 3), ivec3(-1, 1, 3),
    ivec3(0, 1, 2), ivec3(0, 1, -2), ivec3(2, 0, 1), ivec3(-2, 0, 1), ivec3(1, 2, 0), ivec3(1, -2, 0));

ivec3 supportDirection(uint k) { return (k & 1u) == 0u ? kDirections[k >> 1] : -kDirections[k >> 1]; }
