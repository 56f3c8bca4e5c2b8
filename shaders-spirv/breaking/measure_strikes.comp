// How far pieces of bodies that can break are from each place that is struck by hand; what is further than the strike reaches is
// out of reach. The nearest piece of a body counts.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/quaternion.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/hull.h"
#include "shared/solver.h"
#include "shared/strike.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, BodyState, bodies);
READS(2, PieceRecord, pieces);
READS(3, HullRecord, hulls);
READS(4, vec4, hull_vertices);
READS(5, HullFace, hull_faces);
READS(6, uint, hull_corners);
READS(7, BreakableBody, breakable);
READS(8, Strike, strikes);
WRITES(9, uint, distances); // by piece, MOST_STRIKES each: bits of floats that are not negative are in their order
UPDATES(10, uint, nearest); // by body
layout(push_constant) uniform Push { uint count; };
#include "lib/nearest_place.glsl"

const uint kOutOfReach = NO_INDEX;

uint distanceTo(HullRecord hull, BodyState body, Strike strike) {
    vec3 p = strikeIn(body, strike);
    float reach = strike.offset.w;
    if (length(p - hull.center.xyz) > hull.center.w + reach) return kOutOfReach;
    float apart = length(nearestOnHull(hull, p) - p);
    return apart <= reach ? floatBitsToUint(apart) : kOutOfReach;
}

void main() {
    uint piece = flatIndex();
    if (piece >= counts[COUNT_BOXES]) return;
    uint body = pieces[piece].ids.y;
    bool reachable = body != NO_INDEX && (bodies[body].sector.w & BODY_ABSENT) == 0 && breakable[body].surface.w != NO_INDEX;
    for (uint k = 0u; k < min(count, uint(MOST_STRIKES)); k++) {
        uint apart = reachable ? distanceTo(hulls[pieces[piece].ids.x], bodies[body], strikes[k]) : kOutOfReach;
        distances[piece * uint(MOST_STRIKES) + k] = apart;
        if (apart != kOutOfReach) atomicMin(nearest[body * uint(MOST_STRIKES) + k], apart);
    }
}
