// What a blow breaks, by its energy, its speed and the materials. Wants `bodies`, `breakable`, `cards`, `steps` and `duration` declared.
#ifndef WHO_BREAKS_GLSL
#define WHO_BREAKS_GLSL
#include "lib/break_pattern.glsl"
#include "lib/breaking_laws.glsl"

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
#endif
