// Finds the other side of each flap.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, suspects);
READS(2, uint, flap_table);
READS(3, uint, flap_slots);
READS(4, uvec4, pieces);
WRITES(5, uint, partners); // the other side of its flap
#include "lib/flap_key.glsl"

// The rank-th lowest triangle of a slot that faces up or down, NO_INDEX where there are fewer.
uint ranked(uint slot, bool up, uint rank, uint sides) {
    uint found = NO_INDEX;
    for (uint step = 0u; step <= rank; step++) {
        uint next = NO_INDEX;
        for (uint k = 0u; k < sides; k++) {
            uint t = suspectTriangle(k);
            bool later = step == 0u || t > found;
            if (flap_slots[k] == slot && turnsUp(t) == up && later) next = min(next, t);
        }
        found = next;
    }
    return found;
}

uint rankOf(uint slot, bool up, uint triangle, uint sides) {
    uint rank = 0u;
    for (uint k = 0u; k < sides; k++) {
        uint t = suspectTriangle(k);
        if (flap_slots[k] == slot && turnsUp(t) == up && t < triangle) rank++;
    }
    return rank;
}

void main() {
    uint k = flatIndex(), sides = 2u * counts[COUNT_SUSPECTS];
    if (k >= sides || counts[STATUS_FAILED] != 0u) return;
    uint slot = flap_slots[k], t = suspectTriangle(k);
    if (slot == NO_INDEX) {
        partners[k] = NO_INDEX;
        return;
    }
    uint up = flap_table[4u * slot + 2u], down = flap_table[4u * slot + 3u], other = NO_INDEX;
    if (up == 1u && down == 1u) other = (flap_table[4u * slot] - 1u) ^ (flap_table[4u * slot + 1u] - 1u) ^ t;
    // Several flaps in one place pair off from the lowest; where all sides are too many for a lane, they stay.
    if (min(up, down) > 0u && max(up, down) > 1u && max(up, down) <= 4u && sides <= MOST_TURNS / 8u) {
        uint rank = rankOf(slot, turnsUp(t), t, sides);
        if (rank < min(up, down)) other = ranked(slot, !turnsUp(t), rank, sides);
    }
    partners[k] = other;
}
