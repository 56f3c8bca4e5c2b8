// How many pairs, and how many contacts, what breaks is expected to have in the step after, where a host has fixed how many there are.
// Wants what admit_breaking declares.
//
// Fragments among themselves: of cells that are alike and lie evenly, boxes meet in the share of pairs that a product over the axes
// is; cells that crowd about a blow have up to 1.5 times as many (measured: 50, 256, 800 fragments of balls and panes at 20 m/s), so
// that twice as many are reckoned with. With a neighbor that stays whole every fragment may make a pair. With one that breaks, too,
// they meet where the two bodies met: as often as among themselves if the two stood in one place, times the share that lies within
// reach of where they met.
#include "shared/sweep.h"

const float kBoxOfCell = 1.6, kContactsOfOne = 16.0;

bool isRoomForPairsFixed() { return most_pairs != NO_INDEX || most_contacts != NO_INDEX; }

// Where a body stands in the list of what breaks, which is in order; NO_INDEX: nowhere.
uint placeInList(uint body) {
    if (chosen[body] == NO_INDEX) return NO_INDEX;
    uint low = 0u, high = found;
    for (uint turn = 0u; turn < 16u && low < high; turn++) {
        uint middle = (low + high) / 2u;
        if (listed[middle] < body) low = middle + 1u;
        else high = middle;
    }
    return low < found && listed[low] == body ? low : NO_INDEX;
}

void countNeighbors(uint lane) {
    for (uint pair = lane, pairs = world_counts[COUNT_BOX_PAIRS]; pair < pairs; pair += GROUP_SIZE) {
        uvec2 ids = memory[pair].ids.xy, at = uvec2(placeInList(ids.x), placeInList(ids.y));
        bool both = at.x != NO_INDEX && at.y != NO_INDEX;
        for (uint side = 0u; side < 2u; side++) {
            if (at[side] == NO_INDEX) continue;
            atomicAdd(neighbors_of[at[side]].x, 1u);
            if (both) atomicAdd(neighbors_of[at[side]].y, 1u);
        }
    }
}

// Along the axes of the world.
vec3 extentOf(uint body) {
    mat3 axes = matrixOf(turnAfter(bodies[body].turn, breakable[body].turn));
    vec3 size = breakable[body].high.xyz - breakable[body].low.xyz;
    return abs(axes[0]) * size.x + abs(axes[1]) * size.y + abs(axes[2]) * size.z;
}

// To the furthest that any place of it gets in the step to come, as boxes are made.
vec3 sweepOf(uint body) {
    float turning = length(bodies[body].spin.xyz) * shapes[body].inverse_inertia[2].w;
    return SWEEP_AHEAD * duration * (abs(bodies[body].velocity.xyz) + turning);
}

uvec2 pairsFor(uint k, uint body) {
    float n = float(sites_of[k]), all_ = 0.5 * n * (n - 1.0);
    float cell = kBoxOfCell * pow(breakable[body].form.x / n, 1.0 / 3.0);
    vec3 share = min(2.0 * (cell + margin + sweepOf(body)) / max(extentOf(body), 1e-9), 1.0);
    float among = min(2.0 * share.x * share.y * share.z, 1.0) * all_;
    float across = 2.0 * among * max(share.x, max(share.y, share.z)) * float(neighbors_of[k].y);
    float beside = n * float(neighbors_of[k].x) + across;
    return uvec2(ceil(vec2(among, min(among, kContactsOfOne * n)) + beside));
}

uvec2 roomForPairs() {
    uvec2 most = uvec2(most_pairs, most_contacts), now = uvec2(world_counts[COUNT_BOX_PAIRS], world_counts[COUNT_CONTACTS]);
    return most - min(most, now);
}
