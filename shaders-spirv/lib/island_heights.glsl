// How many bodies a small island is high: the longest of the shortest ways along contacts that may lean (lib/pace.glsl), from its bodies
// to a body that does not move. 1 if it touches no such body.
//
// Wants `solver_contacts`, `solver_bodies` and `heights`, which has a word for each body, declared.
const uint kUnknown = 0x7fffffffu, kMostRounds = 8000u; // over vectors of 8 contacts (lib/pace.glsl)

shared uint rose, island_height;

uint heightOf(uint body) { return solver_bodies[body].velocity.w != 0.0 ? heights[body] : 0u; }

// Level by level: a round that is the last one found the same bodies whatever the lanes' order.
void raise(uint body, uint from, uint level) {
    if (from != level || solver_bodies[body].velocity.w == 0.0 || heights[body] != kUnknown) return;
    heights[body] = level + 1u;
    rose = 1u;
}

void raiseNeighbors(uint lane, uvec2 range, uint level) {
    for (uint c = range.x + lane; c < range.y; c += LANES) {
        uvec4 ids = solver_contacts[c].ids;
        if (solver_contacts[c].pace.w == 0u) continue;
        uint a = heightOf(ids.x), b = heightOf(ids.y);
        raise(ids.y, a, level);
        raise(ids.x, b, level);
    }
}

void keepHighest(uint lane, uvec2 range) {
    for (uint c = range.x + lane; c < range.y; c += LANES) {
        uvec4 ids = solver_contacts[c].ids;
        uint a = heightOf(ids.x), b = heightOf(ids.y);
        atomicMax(island_height, max(a == kUnknown ? 1u : a, b == kUnknown ? 1u : b));
    }
}

void clearHeights(uint lane, uvec2 range) {
    for (uint c = range.x + lane; c < range.y; c += LANES) {
        uvec4 ids = solver_contacts[c].ids;
        heights[ids.x] = kUnknown;
        heights[ids.y] = kUnknown;
    }
    if (lane == 0u) island_height = 1u;
}

uint heightOfIsland(uint lane, uvec2 range) {
    clearHeights(lane, range);
    uint rounds = kMostRounds / (1u + (range.y - range.x) / 8u);
    for (uint round = 0u; round < rounds; round++) {
        if (lane == 0u) rose = 0u;
        memoryBarrierBuffer();
        barrier();
        raiseNeighbors(lane, range, round);
        memoryBarrierBuffer();
        barrier();
        if (rose == 0u) break;
        barrier();
    }
    keepHighest(lane, range);
    barrier();
    return island_height;
}
