// The directions in which fragments are measured, a pair of opposite ones a row: axes, corners, edges of a cube, and 36 in
// the gaps between these. Each set holds the smaller ones, so that more directions do not make a collider looser. What lies
// between them is at most 55 degrees from one of 6, 37 from one of 14, 28 of 26, 19 of 62.
//
// Three of them in a word, a component in three bits, picked by a few choices: an array of constants is filled anew wherever a lane
// looks into it, and Mesa 22.3 takes half a second to compile two such looks.
#define TOWARDS(x, y, z) uint((x + 3) | (y + 3) << 3 | (z + 3) << 6)
#define THREE(a, b, c) (a | b << 9 | c << 18)
const uvec4 kDirections0 = uvec4(
    THREE(TOWARDS(1, 0, 0), TOWARDS(0, 1, 0), TOWARDS(0, 0, 1)),
    THREE(TOWARDS(1, 1, 1), TOWARDS(1, 1, -1), TOWARDS(1, -1, 1)),
    THREE(TOWARDS(-1, 1, 1), TOWARDS(0, 1, 1), TOWARDS(0, 1, -1)),
    THREE(TOWARDS(1, 0, 1), TOWARDS(-1, 0, 1), TOWARDS(1, 1, 0)));
const uvec4 kDirections1 = uvec4(
    THREE(TOWARDS(1, -1, 0), TOWARDS(3, 1, 1), TOWARDS(3, 1, -1)),
    THREE(TOWARDS(3, -1, 1), TOWARDS(-3, 1, 1), TOWARDS(1, 3, 1)),
    THREE(TOWARDS(1, 3, -1), TOWARDS(1, -3, 1), TOWARDS(-1, 3, 1)),
    THREE(TOWARDS(1, 1, 3), TOWARDS(1, 1, -3), TOWARDS(1, -1, 3)));
const uvec4 kDirections2 = uvec4(
    THREE(TOWARDS(-1, 1, 3), TOWARDS(0, 1, 2), TOWARDS(0, 1, -2)),
    THREE(TOWARDS(2, 0, 1), TOWARDS(-2, 0, 1), TOWARDS(1, 2, 0)),
    TOWARDS(1, -2, 0),
    0u);

// Direction 2 k is the k-th of the table, 2 k + 1 its opposite.
ivec3 supportDirection(uint k) {
    uint at = k >> 1, word = at / 3u;
    uvec4 row = word < 4u ? kDirections0 : word < 8u ? kDirections1 : kDirections2;
    uvec2 half_ = (word & 2u) == 0u ? row.xy : row.zw;
    uint bits = ((word & 1u) == 0u ? half_.x : half_.y) >> 9u * (at % 3u);
    ivec3 d = ivec3(uvec3(bits, bits >> 3, bits >> 6) & 7u) - 3;
    return (k & 1u) == 0u ? d : -d;
}
