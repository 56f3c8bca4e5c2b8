// Islands: triangles of one cell that share an edge, by position, are one piece. An edge meets its partners in a table; who
// comes first does not matter, since a set is known by its lowest triangle.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uvec4, pieces);
layout(set = 0, binding = 2, std430) coherent buffer parents_block { uint parents[]; };
UPDATES(3, uint, edge_table); // 3 triangle + edge + 1; 0: free
layout(push_constant) uniform Push { uint table_mask; };
#include "lib/union_find.glsl"

uvec3 edgeKey(uvec4 piece, uint k) {
    uint a = piece[k], b = piece[(k + 1u) % 3u];
    return uvec3(min(a, b), max(a, b), piece.w);
}

void main() {
    uint t = flatIndex();
    if (t >= counts[COUNT_TRIANGLES] || counts[STATUS_FAILED] != 0u) return;
    uvec4 piece = pieces[t];
    bool dropped = piece.w == NO_INDEX;
    for (uint k = 0u; k < 3u; k++) {
        uvec3 key = edgeKey(piece, k);
        uint hash = key.x * 0x9e3779b1u ^ (key.y * 0x85ebca6bu + (key.x >> 13)) ^ key.z * 0xc2b2ae35u;
        hash = (hash ^ (hash >> 15)) * 0x2c1b3c6du;
        hash ^= hash >> 13;
        bool settled = dropped;
        for (uint probe = 0u; probe < 1024u && !settled; probe++) {
            uint at = (hash + probe) & table_mask;
            uint held = atomicCompSwap(edge_table[at], 0u, 3u * t + k + 1u);
            uint other = held == 0u ? t : (held - 1u) / 3u;
            bool same = held != 0u && edgeKey(pieces[other], (held - 1u) % 3u) == key;
            settled = held == 0u || same;
            // Straight through: inside an `if` it measured slower where lanes run in step.
            bool united = unite(same ? other : t, t);
            settled = settled && united;
        }
        if (!settled) atomicAdd(counts[STATUS_BAD_UNION], 1u);
    }
}
