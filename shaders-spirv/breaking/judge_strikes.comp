// Which bodies are broken by hand: judged as every blow is, by stress and by energy, as if the body had met, at the nearest place of
// it, a ball of the strike's radius that is as dense as the body and does not give way, so fast that this is the blow's energy. The
// hardest that breaks it counts, one of an earlier step that still waits included. A body that breaks is awake.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/breaking_laws.glsl"
#include "lib/break_pattern.glsl"
#include "lib/rigid.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/hull.h"
#include "shared/solver.h"
#include "shared/strike.h"

FLAT_KERNEL;
READS(0, uint, counts);
UPDATES(1, BodyState, bodies);
READS(2, BodyShape, shapes);
READS(3, PieceRecord, pieces);
READS(4, HullRecord, hulls);
READS(5, vec4, hull_vertices);
READS(6, HullFace, hull_faces);
READS(7, uint, hull_corners);
READS(8, BreakableBody, breakable);
READS(9, MaterialCard, cards);
READS(10, uint, steps);
READS(11, Strike, strikes);
READS(12, uint, claims);
READS(13, uint, reached);
UPDATES(14, StrikeRecord, records);
layout(push_constant) uniform Push { uint count; float duration; };
#include "lib/nearest_place.glsl"
#include "lib/origin.glsl"

// From the place to what strikes it; where that is the same, away from the middle.
vec3 outward(vec3 strike, vec3 place, vec3 middle) {
    vec3 apart = strike - place, out_ = place - middle;
    if (dot(apart, apart) > 1e-12) return normalize(apart);
    return dot(out_, out_) > 1e-12 ? normalize(out_) : vec3(0.0, 1.0, 0.0);
}

// What does not move weighs as its material does.
float densityOf(uint body) {
    float inverse_mass = bodies[body].offset.w;
    return inverse_mass > 0.0 ? 1.0 / (inverse_mass * breakable[body].form.x) : cards[breakable[body].surface.w].elastic.x;
}

float effectiveMass(uint body, vec3 arm, vec3 along, float radius) {
    float ball = densityOf(body) * 4.18879 * radius * radius * radius, inverse_mass = bodies[body].offset.w, turning = 0.0;
    if (inverse_mass > 0.0) turning = turningYield(worldInertia(ownInverseInertia(shapes[body]), bodies[body].turn), arm, along);
    return 1.0 / (1.0 / ball + inverse_mass + turning);
}

StrikeRecord recordOf(uint body, uint k) {
    HullRecord hull = hulls[pieces[claims[body * uint(MOST_STRIKES) + k]].ids.x];
    vec3 strike = strikeIn(bodies[body], strikes[k]), place = nearestOnHull(hull, strike);
    vec3 toward = outward(strike, place, hull.center.xyz), along = turned(bodies[body].turn, toward), arm = turned(bodies[body].turn, place);
    float mass = effectiveMass(body, arm, along, strikes[k].offset.w), energy = strikes[k].energy.x / float(max(reached[k], 1u));
    return StrikeRecord(uvec4(1u, k, bornIn(body), 0u), vec4(mass, sqrt(2.0 * energy / mass), energy, 0.0),
                        vec4(place, strikes[k].offset.w), vec4(toward, 0.0));
}

bool breaksBody(uint body, StrikeRecord record) {
    BreakableBody b = breakable[body];
    Blow blow = Blow(record.blow.x, record.blow.y, float(RIGID_IMPEDANCE));
    return breaks(cards[b.surface.w], formOf(b.form.x, b.form.y), b.form.z, blow, spreadOf(uint(b.high.w)));
}

void main() {
    uint body = flatIndex();
    if (body >= counts[COUNT_BODIES]) return;
    StrikeRecord waits = records[body], hardest = StrikeRecord(uvec4(0u), vec4(0.0), vec4(0.0), vec4(0.0));
    if (waits.what.x != 0u && waits.what.z == bornIn(body)) hardest = waits;
    bool rests = float(steps[STEPS_MADE]) * duration < breakable[body].form.w;
    for (uint k = 0u; k < min(count, uint(MOST_STRIKES)); k++) {
        if (rests || claims[body * uint(MOST_STRIKES) + k] == NO_INDEX) continue;
        StrikeRecord record = recordOf(body, k);
        if (record.blow.z > hardest.blow.z && breaksBody(body, record)) hardest = record;
    }
    records[body] = hardest;
    if (hardest.what.x != 0u) bodies[body].velocity.w = 0.0;
}
