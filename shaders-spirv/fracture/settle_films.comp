// Films that lie against no fragment: in a model as thin as a film all pieces are, and those with room inside are fragments.
// What has none in the end is dissolved, and what faced it becomes outer surface.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/fragment_record.h"
#include "lib/film.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, films);
READS(2, FragmentRecord, records);
UPDATES(3, uvec2, fates);
layout(push_constant) uniform Push {
    float least; // share of a film's greatest volume from which a piece is a fragment
    uint is_last;
    float step_size;
};

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_FILMS] || counts[STATUS_FAILED] != 0u) return;
    uint c = films[k];
    if (fates[c].x != FATE_FILM) return;
    bool solid = records[c].measure.x > least * filmVolume(records[c], step_size);
    if (!solid && is_last != 0u) atomicAdd(counts[STATUS_DISSOLVED], 1u);
    fates[c].x = solid ? FATE_FRAGMENT : (is_last != 0u ? FATE_DISSOLVED : FATE_FILM);
}
