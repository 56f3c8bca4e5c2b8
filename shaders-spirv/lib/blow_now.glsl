// What is left of a blow now that the step is over: the two bodies that met, how they move, and the energy that they have along the
// normal. Other contacts of theirs have been solved since the blow was judged, and may have taken some of it or all. Wants
// `counts`, `broken`, `bodies` and `shapes` declared.
#include "lib/body_way.glsl"
#include "lib/breaking_laws.glsl"
#include "lib/rigid.glsl"

struct Mover {
    uint body;
    vec3 arm;
    float inverse_mass;
    mat3 inverse;
};

Mover moverOf(uint body, vec3 arm) {
    return Mover(body, arm, bodies[body].offset.w, worldInertia(ownInverseInertia(shapes[body]), bodies[body].turn));
}

vec3 velocityOf(Mover m) { return bodies[m.body].velocity.xyz + cross(bodies[m.body].spin.xyz, m.arm); }

float yieldOf(Mover m, vec3 n) { return m.inverse_mass + turningYield(m.inverse, m.arm, n); }

// Of the blow, from the center of mass of the body that it breaks, as that stands now.
vec3 placeOfBlow(uint k) { return turned(bodies[broken[k].ids.x].turn, broken[k].place.xyz); }

Mover struckBy(uint k) { return moverOf(broken[k].ids.x, placeOfBlow(k)); }

// At the same place, or the pair would gain angular momentum.
Mover striking(uint k) {
    uvec2 ids = broken[k].ids.xy;
    Mover other = moverOf(ids.y, placeOfBlow(k) - wayBetween(ids.x, ids.y));
    if (other.inverse_mass == 0.0) other.arm = vec3(0.0); // of an endless plane, say
    return other;
}

Blow blowNow(Mover own, Mover other, vec3 n) {
    float yield_ = yieldOf(own, n) + yieldOf(other, n), speed = max(-dot(n, velocityOf(other) - velocityOf(own)), 0.0);
    return Blow(yield_ > 0.0 ? 1.0 / yield_ : 0.0, speed, float(RIGID_IMPEDANCE));
}

// The other object of the same pair, NO_INDEX where there is none.
uint partnerOf(uint k) {
    if (broken[k].ids.y == NO_INDEX) return NO_INDEX;
    uint objects = min(counts[COUNT_BREAKING], uint(MOST_BREAKING));
    for (uint j = 0u; j < objects; j++)
        if (j != k && broken[j].ids.z == broken[k].ids.z) return j;
    return NO_INDEX;
}
