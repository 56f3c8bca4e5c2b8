// Notes with both bodies of a pair that they touch, if they have touched nothing earlier. A hull that lies beside a triangle, behind a
// hidden side of it, does not touch it.
//
// Wants `pair`, `push` and `first_hits` declared.
#ifndef NOTE_HIT_GLSL
#define NOTE_HIT_GLSL
#include "lib/first_hit.glsl"

void noteOrder(uint body, bool other_moves, uint order) {
    if (other_moves) atomicMin(first_hits[body].moving_order, order);
    else atomicMin(first_hits[body].fixed_order, order);
}

void noteHit(AxisRecord record) {
    if (push.hides == 0u || !touches(record) || !isFastOrTurns(pair)) return;
    bool moves_a = moves(pair.ids.z), moves_b = moves(pair.ids.w);
    uint order = orderOfHit(record);
    if (moves_a) noteOrder(pair.ids.z, moves_b, order);
    if (moves_b) noteOrder(pair.ids.w, moves_a, order);
}

#endif
