// Own surface, face of an earlier cut or inner, for every sorted triangle: a cap is inner while the piece behind it exists.
// Triangles of the mesh behind its own ones lie on faces of earlier cuts.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, order);
READS(2, uint, sources);
READS(3, uint, components);
READS(4, uvec2, fates);
WRITES(5, uvec4, classes);
READS(6, uint, parents);
#include "lib/piece_behind.glsl"

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_VALID] || counts[STATUS_FAILED] != 0u) return;
    uint t = order[k];
    bool cap = (sources[t] & INNER_BIT) != 0u;
    uint behind = cap ? pieceBehind(t, counts[COUNT_MESH_TRIANGLES] + counts[COUNT_FAN_TRIANGLES]) : t;
    uint mate = components[behind];
    bool faced = mate != NO_INDEX && fates[mate != NO_INDEX ? mate : components[t]].x != FATE_DISSOLVED;
    bool stays = fates[components[t]].x != FATE_DISSOLVED;
    bool inner = cap && faced, earlier = !cap && sources[t] >= counts[COUNT_OWN_TRIANGLES];
    classes[k] = uvec4(stays && !inner && !earlier ? 1u : 0u, stays && earlier ? 1u : 0u, stays && inner ? 1u : 0u, 0u);
}
