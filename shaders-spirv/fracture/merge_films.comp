// Gives the triangles of joined films to their host's cell, and drops the caps that then lie between two pieces of one cell, so
// that islands can be found anew: a film may have been all that held two parts of a piece together.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/fragment_record.h"

FLAT_KERNEL;
READS(0, uint, counts);
UPDATES(1, uvec4, pieces);
READS(2, uint, sources);
UPDATES(3, uint, parents);
READS(4, uint, components);
READS(5, uvec2, fates);
READS(6, FragmentRecord, records);
#include "lib/piece_behind.glsl"

uint cellOf(uint component) { return records[fates[component].y].fate.z; }

void main() {
    uint t = flatIndex();
    if (t >= counts[COUNT_TRIANGLES] || counts[STATUS_FAILED] != 0u) return;
    uint mine = components[t];
    if (mine == NO_INDEX) return;
    bool cap = (sources[t] & INNER_BIT) != 0u;
    uint other = cap ? components[pieceBehind(t, counts[COUNT_MESH_TRIANGLES] + counts[COUNT_FAN_TRIANGLES])] : NO_INDEX;
    uint cell = cellOf(mine);
    bool within = other != NO_INDEX && cellOf(other) == cell;
    pieces[t].w = within ? NO_INDEX : cell;
    parents[t] = t;
}
