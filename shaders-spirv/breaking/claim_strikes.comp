// The piece of each body that is struck: the nearest, and the first of those that are as near.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/solver.h"
#include "shared/strike.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, PieceRecord, pieces);
READS(2, uint, distances);
READS(3, uint, nearest);
UPDATES(4, uint, claims); // by body, MOST_STRIKES each: a piece
layout(push_constant) uniform Push { uint count; };

void main() {
    uint piece = flatIndex();
    if (piece >= counts[COUNT_BOXES]) return;
    uint body = pieces[piece].ids.y;
    for (uint k = 0u; k < min(count, uint(MOST_STRIKES)); k++) {
        uint apart = distances[piece * uint(MOST_STRIKES) + k];
        if (apart != NO_INDEX && apart == nearest[body * uint(MOST_STRIKES) + k]) atomicMin(claims[body * uint(MOST_STRIKES) + k], piece);
    }
}
