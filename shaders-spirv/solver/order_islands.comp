// The contacts of one small island, color by color, and where each color ends: a workgroup an island.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/solver.h"

#define LANES 16u
layout(local_size_x = LANES) in;
READS(0, uint, color_start);
READS(1, uint, contact_pairs);
READS(2, ContactMemory, memory);
READS(3, uvec2, island_ranges);
READS(4, uint, listed);
WRITES(5, uint, contact_slots);
WRITES(6, uint, color_ends); // of the first of a color; what has no color ends with each

shared uint count[NO_COLOR + 1], cursor[NO_COLOR + 1];

uint colorOf(uint c) { return min(memory[contact_pairs[c]].ids.w, NO_COLOR); }

void countColors(uint lane, uvec2 range) {
    for (uint k = lane; k <= NO_COLOR; k += LANES) count[k] = 0u;
    barrier();
    for (uint at = range.x + lane; at < range.y; at += LANES) atomicAdd(count[colorOf(listed[at])], 1u);
    barrier();
}

void endColors(uint lane, uvec2 range) {
    if (lane == 0u) {
        uint sum = range.x;
        for (uint k = 0u; k <= NO_COLOR; k++) {
            cursor[k] = sum;
            sum += count[k];
            if (count[k] != 0u && k < NO_COLOR) color_ends[cursor[k]] = sum;
        }
    }
    barrier();
}

// Of what has no color, which is solved one after the other, in the order of contacts: how many come before.
uint rankOf(uint c, uvec2 range) {
    uint rank = 0u;
    for (uint at = range.x; at < range.y; at++) rank += listed[at] < c && colorOf(listed[at]) == NO_COLOR ? 1u : 0u;
    return rank;
}

void main() {
    uint lane = gl_LocalInvocationID.x, group = flatGroup();
    if (group >= color_start[ISLANDS_APART]) return;
    uvec2 range = island_ranges[group];
    countColors(lane, range);
    endColors(lane, range);
    for (uint at = range.x + lane; at < range.y; at += LANES) {
        uint c = listed[at], color = colorOf(c);
        if (color != NO_COLOR) contact_slots[c] = atomicAdd(cursor[color], 1u);
    }
    if (count[NO_COLOR] == 0u) return;
    for (uint at = range.x + lane; at < range.y; at += LANES) {
        uint c = listed[at];
        if (colorOf(c) != NO_COLOR) continue;
        uint slot = cursor[NO_COLOR] + rankOf(c, range);
        contact_slots[c] = slot;
        color_ends[slot] = slot + 1u;
    }
}
