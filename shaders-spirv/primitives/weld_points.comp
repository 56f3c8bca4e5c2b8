// Finds points that coincide, word for word (-0.0 is 0.0). A slot of the table belongs to one position and ends up holding the lowest id
// there, whoever came first: which slot that is depends on the run, the classes and their lowest ids do not.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

#ifndef WORDS
#define WORDS 6
#define STRIDE 6
#endif
FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, points);
UPDATES(2, uint, point_table); // id + 1; 0: free
WRITES(3, uint, point_slots);
#ifdef THROUGH
READS(4, uint, first_points); // the point to look at in place of each
#endif
layout(push_constant) uniform Push {
    uint length;
    uint length_count;
    uint table_mask;
};

uint wordOf(uint id, uint k) {
#ifdef THROUGH
    id = first_points[id];
#endif
    uint word = points[STRIDE * id + k];
    return word == 0x80000000u ? 0u : word;
}

bool same(uint a, uint b) {
    bool equal = true;
    for (uint k = 0u; k < ROLLED(WORDS); k++) equal = equal && wordOf(a, k) == wordOf(b, k);
    return equal;
}

void main() {
    uint id = flatIndex();
    uint n = length_count == NO_INDEX ? length : counts[length_count];
    if (id >= n || counts[STATUS_FAILED] != 0u) return;
    uint hash = 0x811c9dc5u;
    for (uint k = 0u; k < ROLLED(WORDS); k++) {
        hash = (hash ^ wordOf(id, k)) * 0x01000193u;
        hash ^= hash >> 15;
    }
    hash = (hash ^ (hash >> 16)) * 0x85ebca6bu;
    hash ^= hash >> 13;
    uint slot = NO_INDEX;
    for (uint probe = 0u; probe < 1024u && slot == NO_INDEX; probe++) {
        uint at = (hash + probe) & table_mask;
        uint held = atomicCompSwap(point_table[at], 0u, id + 1u);
        if (held == 0u) slot = at;
        else if (same(held - 1u, id)) {
            atomicMin(point_table[at], id + 1u);
            slot = at;
        }
    }
    if (slot == NO_INDEX) {
        atomicAdd(counts[STATUS_BAD_WELD], 1u);
        atomicOr(counts[STATUS_FAILED], FAILED_CAPACITY);
    }
    point_slots[id] = slot == NO_INDEX ? 0u : slot;
}
