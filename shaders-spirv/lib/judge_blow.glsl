// What a blow breaks, by its energy, its speed and the materials; and its record. Wants `bodies`, `breakable`, `cards`, `steps`, `counts`,
// `blows`, `touches`, `duration`, and `gravity`, whose w is the length of a substep, declared.
#include "lib/break_pattern.glsl"
#include "lib/breaking_laws.glsl"

// Until when the solver brakes what comes closer, s.
float horizon() { return duration + AHEAD_OF_STEP * gravity.w; }

bool canBreak(uint body) {
    return breakable[body].surface.y > 0u && float(steps[STEPS_MADE]) * duration >= breakable[body].form.w;
}

float impedanceOf(uint body) {
    uint material = breakable[body].surface.w;
    return material != NO_INDEX ? cards[material].elastic.z : float(RIGID_IMPEDANCE);
}

// By the energy of the blow, or, where both break, by half of it each.
bool breaksBody(uint body, uint other, BlowRecord record, float share) {
    if (!canBreak(body)) return false;
    BreakableBody b = breakable[body];
    BodyForm form = formOf(b.form.x, b.form.y);
    MaterialCard card = cards[b.surface.w];
    Blow blow = Blow(record.blow.x, record.blow.y, impedanceOf(other));
    uint spread = spreadOf(uint(b.high.w));
    return breaks(card, form, b.form.z, blow, spread) && paysForTwo(card, form, share * energyOf(blow), spread);
}

uint sidesThatBreak(uvec2 ids, BlowRecord record) {
    bool a = breaksBody(ids.x, ids.y, record, 0.5), b = breaksBody(ids.y, ids.x, record, 0.5);
    if (a && b) return BREAKS_A | BREAKS_B;
    a = a || breaksBody(ids.x, ids.y, record, 1.0);
    b = b || (!a && breaksBody(ids.y, ids.x, record, 1.0));
    return (a ? BREAKS_A : 0u) | (b ? BREAKS_B : 0u);
}

// `share`: of the step that is over when they meet.
BlowRecord blowAt(float yield_, float speed, float share, vec3 arm_a, vec3 arm_b, vec3 normal) {
    return BlowRecord(uvec4(0u, floatBitsToUint(share), 0u, 0u), vec4(1.0 / yield_, speed, 0.5 * speed * speed / yield_, min(share, 1.0)),
                      vec4(arm_a, 0.0), vec4(arm_b, 0.0), vec4(normal, 0.0));
}

// `time`: s until they meet. What meets only when the step is over, and then breaks something, is left alone until then: the solver would
// brake it, and it would break in the air.
void tellBlow(uint pair, uvec2 ids, BlowRecord record, float time) {
    record.sides.x = sidesThatBreak(ids, record);
    bool breaks_ = record.sides.x != 0u, is_later = time > duration;
    if (!is_later) blows[pair] = record;
    if (breaks_ && is_later) touches[pair] = 0u;
    if (breaks_ && !is_later) atomicAdd(counts[COUNT_BLOWS], 1u);
}
