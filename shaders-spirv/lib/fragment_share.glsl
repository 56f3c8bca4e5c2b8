// How many fragments a body may become where the world has little room for fragments. Each body of the scene that has not broken
// yet has a few kept for it, so that what is hit first does not use up what others need. Fragments that break again leave half
// of the budget to such bodies. Wants what admit_breaking declares.
#include "shared/pool.h"

const uint kMostOfEven = 8u; // even shares, that one of many bodies may take

shared uint whole_bodies;            // of the scene that can break and have not
shared uint limit_of[MOST_BREAKING]; // fragments, of those listed; at most most_fragments

void countWhole(uint lane) {
    if (lane == 0u) whole_bodies = 0u;
    barrier();
    uint own = 0u, slots = world_counts[COUNT_BODIES];
    for (uint body = lane; body < slots; body += GROUP_SIZE) own += isWhole(body) ? 1u : 0u;
    if (own != 0u) atomicAdd(whole_bodies, own);
    barrier();
}

// The share of `left` free fragments; `others`: other bodies that have not broken yet.
uint shareFor(bool whole, uint left, uint others) {
    uint kept = others * kept_for_each;
    if (!whole && others != 0u) kept = max(kept, kept_for_whole);
    uint open = left - min(left, kept);
    if (!whole) return open / 4u;
    if (others == 0u) return open;
    uint even = left / (others + 1u), fair = even < open ? kMostOfEven * even : open;
    return min(left, max(min(open / 2u, fair), kept_for_each));
}

// In order, by one lane: what one takes the next has not.
void shareRoom() {
    uint left = pools[POOL_BODIES].capacity - pools[POOL_BODIES].in_use, others = whole_bodies;
    for (uint k = 0u; k < found; k++) {
        bool whole = isWhole(listed[k]);
        others -= whole ? 1u : 0u;
        uint share = shareFor(whole, left, others);
        limit_of[k] = share >= sites_of[k] ? most_fragments : share;
        left -= min(left, min(sites_of[k], limit_of[k]));
    }
}

bool isRoomFor(uint k) { return limit_of[k] >= 2u; }

void cutToShare(uint k, uint body) {
    if (!isRoomFor(k) || sites_of[k] <= limit_of[k]) return;
    Rays rays = isRadial(body) ? raysOf(k, body, limit_of[k]) : Rays(limit_of[k], 1u, 0.0, 0.0);
    sites_of[k] = rays.spokes * rays.rings;
}
