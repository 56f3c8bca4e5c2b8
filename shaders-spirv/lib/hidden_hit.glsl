// Sides that are hidden. A body meets a floor of several pieces. Its straight way leads on below the floor, into the sides of the next
// pieces; a corner that has turned into the floor is nearer to such a side than to the top. But what a body touches first stops it.
// It comes no closer along that normal. A piece that is no deeper in the body along this normal is touched along it, if at all. What was to
// be hit later is not hit then.
//
// That holds for bodies that are fast or turn swiftly. For what slides along a floor see lib/graze.glsl.
//
// Wants lib/hull_pair.glsl, `push`, `pairs`, `axes`, `first_hits`, `kFar` and `normalOf`.
#ifndef HIDDEN_HIT_GLSL
#define HIDDEN_HIT_GLSL
#include "lib/first_hit.glsl"
#include "lib/strip.glsl"

const float kSameAxis = 1.0 - 1e-6; // cosine
const float kLevelWith = 0.98;      // the same, of a face that is level with the floor

uvec2 bodiesOf(uint k) { return uvec2(pieces[pairs[k].x].ids.y, pieces[pairs[k].y].ids.y); }

bool joins(uint k, uint a, uint b) {
    if (k == NO_HIT) return false;
    uvec2 of = bodiesOf(k);
    return of == uvec2(a, b) || of == uvec2(b, a);
}

// The pair in which these bodies touch first, or in which one of them first touches anything that does not move. NO_HIT for none.
uint firstHit() {
    uint a = pair.ids.z, b = pair.ids.w;
    bool moves_a = moves(a), moves_b = moves(b);
    if (!(moves_a && moves_b)) return first_hits[moves_a ? a : b].fixed_pair;
    uint of_a = first_hits[a].moving_pair, of_b = first_hits[b].moving_pair;
    return joins(of_a, a, b) ? of_a : joins(of_b, a, b) ? of_b : NO_HIT;
}

// In the frame of this pair.
struct Hit {
    vec3 axis;  // from A to B
    vec3 shift; // of B until then
    float gap;  // that is left then along the axis
};

// The body that moves may be A in one pair and B in the other. Then the other hit is seen the other way round.
Hit hitOf(uint k) {
    AxisRecord record = axes[k];
    uint mover = moves(pair.ids.w) ? pair.ids.w : pair.ids.z;
    uvec2 of = bodiesOf(k);
    float sign_ = (of.y == mover) == (pair.ids.w == mover) ? 1.0 : -1.0;
    vec4 turn = turnAfter(turnBack(pair.turn), bodies[of.x].turn);
    return Hit(sign_ * turned(turn, record.axis.xyz), sign_ * turned(turn, record.shift.xyz), record.axis.w);
}

// The highest corner of A and the lowest of B along an axis.
vec2 facingHeights(vec3 axis) {
    vec2 heights = vec2(-kFar, kFar);
    for (uint v = 0u; v < pair.hull[0].count.x; v++) heights.x = max(heights.x, dot(axis, cornerAt(pair, true, v)));
    for (uint v = 0u; v < pair.hull[1].count.x; v++) heights.y = min(heights.y, dot(axis, cornerAt(pair, false, v)));
    return heights;
}

// The face that looks most squarely along a direction, and the cosine.
uint faceAlong(bool of_a, vec3 direction, out float square) {
    uint best = 0u;
    square = -1.0;
    for (uint f = 0u; f < facesOf(of_a); f++) {
        float cosine = dot(normalOf(of_a, f), direction);
        best = cosine > square ? f : best;
        square = max(square, cosine);
    }
    return best;
}

// Which hull has the floor: what does not move, or whose face is more level. But one whose face is level goes before one that has none.
bool hasFloorA(float square_a, float square_b) {
    bool moves_a = moves(pair.ids.z), moves_b = moves(pair.ids.w);
    bool first_is_a = moves_a == moves_b ? square_a >= square_b : moves_b;
    return (first_is_a ? square_a : square_b) >= kLevelWith ? first_is_a : !first_is_a;
}

const AxisRecord kNotTouched = AxisRecord(vec4(0.0), vec4(0.0), uvec4(AXIS_APART));

// Points on the face that is level with the floor.
AxisRecord alongFloor(Hit first) {
    float square_a, square_b;
    uint face_a = faceAlong(true, first.axis, square_a), face_b = faceAlong(false, -first.axis, square_b);
    bool a_leads = hasFloorA(square_a, square_b);
    if ((a_leads ? square_a : square_b) < kLevelWith) return kNotTouched;
    vec3 axis = a_leads ? normalOf(true, face_a) : -normalOf(false, face_b);
    vec2 heights = facingHeights(axis);
    uint feature = (a_leads ? AXIS_FACE_A : AXIS_FACE_B) << AXIS_KIND_SHIFT | AXIS_GRAZES | (a_leads ? face_a : face_b);
    return AxisRecord(vec4(axis, heights.y - heights.x), vec4(vec3(0.0), a_leads ? heights.x : -heights.y),
                      uvec4(feature, a_leads ? 0u : 1u, a_leads ? uvec2(face_a, face_b) : uvec2(face_b, face_a)));
}

bool hides(Hit first, vec3 axis) {
    vec2 heights = facingHeights(first.axis);
    float gap = heights.y + dot(first.axis, first.shift) - heights.x;
    float slack = max(stripBetween(push.strip, pair.smaller), pair.rounding);
    return gap >= first.gap - slack && dot(first.axis, axis) < kSameAxis;
}

// Returns the record as it was found, unless what is touched first hides that axis.
AxisRecord unlessHidden(uint k, AxisRecord record) {
    if (push.hides == 0u || record.info.x == AXIS_APART || !isFastOrTurns(pair)) return record;
    uint other = firstHit();
    if (other == NO_HIT || other == k) return record;
    Hit first = hitOf(other);
    if (!hides(first, record.axis.xyz)) return record;
    return record.shift.xyz != vec3(0.0) ? kNotTouched : alongFloor(first);
}

#endif
