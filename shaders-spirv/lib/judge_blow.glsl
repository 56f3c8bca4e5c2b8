// What a blow breaks, and its record. Wants what lib/who_breaks.glsl wants, and `counts`, `blows`, `touches` and `gravity`, whose w is the
// length of a substep, declared.
#include "lib/who_breaks.glsl"

// Until when the solver brakes what comes closer, s.
float horizon() { return duration + AHEAD_OF_STEP * gravity.w; }

// `time`: s until they meet. What meets only when the step is over, and then breaks something, is left alone until then: the solver would
// brake it, and it would break in the air.
void tellBlow(uint pair, uvec2 ids, BlowRecord record, float time) {
    record.sides.x = sidesThatBreak(ids, record);
    bool breaks_ = record.sides.x != 0u, is_later = time > duration;
    if (!is_later) blows[pair] = record;
    if (breaks_ && is_later) touches[pair] = 0u;
    if (breaks_ && !is_later) atomicAdd(counts[COUNT_BLOWS], 1u);
}
