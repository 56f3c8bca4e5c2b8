// Contacts of small islands, set apart from the others: each island has a range of its own, behind all that go by color alone.
// Wants one workgroup, the kernel's buffers, `colorOf`, `ordered`, how many go by color, and what is known of all colors.
shared uint island_count, small_count, set_apart;

uint islandOf(uint c) {
    uvec4 ids = memory[contact_pairs[c]].ids;
    return islands[moves(ids.x) ? ids.x : ids.y];
}

bool isSmall(uint contacts) { return contacts <= few_contacts; }

// How many contacts each island has, and a list of those that have any, in `waiting`.
void countIslands(uint lane, uint total) {
    if (lane == 0u) {
        island_count = 0u;
        small_count = 0u;
        set_apart = 0u;
    }
    sync();
    for (uint c = lane; c < total; c += LANES) {
        uint island = islandOf(c);
        if (atomicAdd(island_contacts[island], 1u) == 0u) waiting[atomicAdd(island_count, 1u)] = island;
    }
    sync();
}

bool isApart(uint c) { return isSmall(island_contacts[islandOf(c)]); }

// Returns how many islands are set apart.
uint setApart(uint lane, uint total) {
    for (uint k = lane; k < island_count; k += LANES) {
        uint contacts = island_contacts[waiting[k]];
        waiting[k + capacity] = NO_INDEX;
        if (!isSmall(contacts)) continue;
        uint first = ordered + atomicAdd(set_apart, contacts), at = atomicAdd(small_count, 1u);
        island_ranges[at] = uvec2(first, first + contacts);
        waiting[k + capacity] = first;
    }
    sync();
    for (uint k = lane; k < island_count; k += LANES) island_contacts[waiting[k]] = waiting[k + capacity];
    sync();
    for (uint c = lane; c < total; c += LANES) {
        uint island = islandOf(c);
        if (island_contacts[island] == NO_INDEX) continue;
        listed[atomicAdd(island_contacts[island], 1u)] = c;
        uint color = colorOf(c);
        if (color < NO_COLOR) atomicMax(colors_used, color + 1u);
        else atomicAdd(colorless, 1u);
    }
    sync();
    return small_count;
}
