// How far corners and tests in fp32 may be off, for cells whose planes are bisectors d.w <= d.d with d exact: roundoff 2^-23 an
// operation, since Vulkan fixes no rounding mode; contraction only helps.
//
// A corner of bisectors a, b, e may be off by kCornerError |a| |b| |e| (|a| + |b| + |e| + |w|) / volume and kTestError of its own
// size; a test e.w > e.e by |e| times the corner's error and kTestError e.e.
const float kRoundoff = 1.0 / 8388608.0;
const float kCornerError = 13.0 * kRoundoff; // one is for walls across the whole grid, which fp32 may round
const float kTestError = 8.0 * kRoundoff;
// Corners that are quotients of exact integers: a few roundings each, then three products and sums in a test.
const float kPlaceError = 16.0 * kRoundoff;
const float kMaxRelativeError = 0.2; // beyond, a corner says nothing

float sumOfSizes(vec3 w) { return abs(w.x) + abs(w.y) + abs(w.z); }
