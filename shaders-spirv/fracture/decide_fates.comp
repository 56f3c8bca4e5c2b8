// What becomes of each component. Thinner than about two grid steps: a film, for which join_films finds a host. Turned inside
// out: a cavity, listed for nest_cavities. Everything else is a fragment. Negative volume made of caps is rounding as well.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/fragment_record.h"
#include "lib/film.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, FragmentRecord, records);
WRITES(2, uvec2, fates);
WRITES(3, uint, cavities);
WRITES(4, uint, films);
layout(push_constant) uniform Push { float step_size; };

void main() {
    uint c = flatIndex();
    if (c >= counts[COUNT_COMPONENTS] || counts[STATUS_FAILED] != 0u) return;
    FragmentRecord mine = records[c];
    float volume = mine.measure.x, thin = filmVolume(mine, step_size);
    bool film = volume <= thin && (volume >= -thin || mine.measure.z < 0.9 * mine.measure.y), cavity = !film && volume < 0.0;
    if (film) films[atomicAdd(counts[COUNT_FILMS], 1u)] = c;
    if (cavity) cavities[atomicAdd(counts[COUNT_CAVITIES], 1u)] = c;
    fates[c] = uvec2(film ? FATE_FILM : (cavity ? FATE_CAVITY : FATE_FRAGMENT), c);
}
