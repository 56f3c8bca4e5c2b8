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

// A loop, and not four calls: drivers that compile for processors would have the laws four times over.
uint sidesThatBreak(uvec2 ids, BlowRecord record) {
    uint by_half = 0u, by_all = 0u;
    for (uint k = 0u; k < 4u; k++) {
        bool is_a = (k & 1u) == 0u, is_half = k < 2u;
        uvec2 of = is_a ? ids : ids.yx;
        uint side = breaksBody(of.x, of.y, record, is_half ? 0.5 : 1.0) ? (is_a ? BREAKS_A : BREAKS_B) : 0u;
        by_half |= is_half ? side : 0u;
        by_all |= side;
    }
    if (by_half == (BREAKS_A | BREAKS_B)) return by_half;
    return (by_all & BREAKS_A) != 0u ? BREAKS_A | by_half : by_all;
}

// `share`: of the step that is over when they meet.
BlowRecord blowAt(float yield_, float speed, float share, vec3 arm_a, vec3 arm_b, vec3 normal) {
    return BlowRecord(uvec4(0u, floatBitsToUint(share), 0u, 0u), vec4(1.0 / yield_, speed, 0.5 * speed * speed / yield_, min(share, 1.0)),
                      vec4(arm_a, 0.0), vec4(arm_b, 0.0), vec4(normal, 0.0));
}
#endif
