// Names the pair in which each body touches something first; one lane per pair. If several pairs have the same order, the lowest index counts.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/narrow_phase.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec2, pairs);
READS(2, PieceRecord, pieces);
READS(3, BodyState, bodies);
READS(4, AxisRecord, axes);
UPDATES(5, FirstHits, first_hits);
layout(push_constant) uniform Push { NarrowPhasePush push; };

#include "lib/first_hit.glsl"

void nameOf(uint body, bool other_moves, uint order, uint k) {
    if (other_moves && first_hits[body].moving_order == order) atomicMin(first_hits[body].moving_pair, k);
    if (!other_moves && first_hits[body].fixed_order == order) atomicMin(first_hits[body].fixed_pair, k);
}

void main() {
    uint k = flatIndex();
    if (k >= min(counts[push.count_at], push.capacity)) return;
    AxisRecord record = axes[k];
    if (!touches(record)) return;
    uint a = pieces[pairs[k].x].ids.y, b = pieces[pairs[k].y].ids.y, order = orderOfHit(record);
    bool moves_a = moves(a), moves_b = moves(b);
    if (moves_a) nameOf(a, moves_b, order, k);
    if (moves_b) nameOf(b, moves_a, order, k);
}
