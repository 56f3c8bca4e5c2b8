// Places of what breaks, from its object's center in units of half a grid's edge, on the grid of its tile.
const float kHalfEdge = 8388608.0; // grid steps

ivec3 onGrid(vec3 place) { return ivec3(roundEven(place * kHalfEdge)) + ivec3(1 << 23); }
