// The sides of a cap as loops: opposite ones cancel, the rest is chained, at a shared corner by the sharpest left turn; loops are
// labeled by their lowest node and measured.
//
// Wants LANES, MAX_NODES, MAX_LOOPS, lib/cap_plane.glsl, and segments, welded, nodes, rings, loops and loose_caps declared.

#define DEAD 0
#define ALIVE 1
#define EAR 2

shared uint outers[MAX_LOOPS];
shared uint holes[MAX_LOOPS];
shared uint lane_pick[LANES];
shared int64_t lane_key[LANES];
shared uint node_total, cleared, hole_total, outer_total;

uint base, slots, plane_u, plane_w;

ivec2 at(uint k) { return nodes[base + k].xy; }
bool live(uint k) { return nodes[base + k].w != DEAD; }
uint nextOf(uint k) { return rings[base + k].x; }
uint previousOf(uint k) { return rings[base + k].y; }
ivec2 placeOf(uint id) { return ivec2(capCoordinate(id, plane_u), capCoordinate(id, plane_w)); }

void saveCap(uint slot, uint a, uint b, uint c) {
    loose_caps[3u * slot] = uint(nodes[base + a].z);
    loose_caps[3u * slot + 1u] = uint(nodes[base + b].z);
    loose_caps[3u * slot + 2u] = uint(nodes[base + c].z);
}

void sync() {
    memoryBarrierBuffer();
    barrier();
}

void loadEdges(uint lane, uint first, uint n) {
    for (uint k = lane; k < n; k += LANES) {
        uvec4 s = segments[first + k];
        uint a = welded[s.x], rank = 0u; // by source: the order in the list is that of atomics
        for (uint o = 0u; o < n; o++) rank += segments[first + o].z < s.z ? 1u : 0u;
        nodes[base + rank] = ivec4(placeOf(a), int(a), ALIVE);
        rings[base + rank] = uvec4(s.z, 0u, welded[s.y], 0u);
    }
    sync();
    for (uint k = lane; k < n; k += LANES) {
        uint a = uint(nodes[base + k].z), b = rings[base + k].z, order = rings[base + k].x;
        uint earlier = 0u, along = 0u, against = 0u;
        for (uint s = 0u; s < n; s++) {
            uint sa = uint(nodes[base + s].z);
            uvec4 ring = rings[base + s];
            bool same = sa == a && ring.z == b;
            along += same ? 1u : 0u;
            earlier += same && ring.x < order ? 1u : 0u;
            against += sa == b && ring.z == a ? 1u : 0u;
        }
        rings[base + k].w = a != b && along > against && earlier < along - against ? 1u : 0u;
    }
    sync();
    for (uint k = lane; k < n; k += LANES) {
        nodes[base + k].w = rings[base + k].w != 0u ? ALIVE : DEAD;
        rings[base + k].x = NO_INDEX;
        rings[base + k].y = NO_INDEX;
    }
    sync();
}

uint bestWayOut(uint n, uint into, uint place) {
    uint best = NO_INDEX;
    ivec2 here = placeOf(place), back = at(into) - here, best_way = ivec2(0);
    for (uint s = 0u; s < n; s++) {
        if (live(s) && uint(nodes[base + s].z) == place && previousOf(s) == NO_INDEX) {
            ivec2 way = placeOf(rings[base + s].z) - here;
            if (best == NO_INDEX || furtherLeft(back, way, best_way)) {
                best = s;
                best_way = way;
            }
        }
    }
    return best;
}

// Where one edge leaves a place, it follows the one that comes there, and nothing else has to be looked at.
bool isChained(uint n, uint into, uint place) {
    uint exits = 0u, follow = 0u;
    for (uint s = 0u; s < n; s++) {
        ivec4 node = nodes[base + s];
        bool leaves = node.w != DEAD && uint(node.z) == place;
        follow = leaves ? s : follow;
        exits += leaves ? 1u : 0u;
    }
    if (exits == 1u) {
        rings[base + into].x = follow;
        rings[base + follow].y = into;
    }
    return exits == 1u;
}

// The lane of the lowest edge into a place serves all edges there, so that ways in and out pair off one to one.
void chainEdges(uint lane, uint n) {
    for (uint k = lane; k < n; k += LANES) {
        uint place = rings[base + k].z;
        bool leads = live(k) && !isChained(n, k, place);
        for (uint s = 0u; s < k && leads; s++) leads = !(live(s) && rings[base + s].z == place);
        uint into = k;
        for (uint served = 0u; served < 64u && leads; served++) {
            uint best = bestWayOut(n, into, place);
            if (best != NO_INDEX) {
                rings[base + into].x = best;
                rings[base + best].y = into;
            }
            uint following = NO_INDEX;
            for (uint s = into + 1u; s < n && following == NO_INDEX; s++) {
                if (live(s) && rings[base + s].z == place) following = s;
            }
            leads = following != NO_INDEX;
            into = leads ? following : into;
        }
    }
    sync();
}

// Signs that were rounded may leave an outline open: nothing can be chained into loops then.
bool hasGaps(uint lane, uint n) {
    if (lane == 0u) cleared = 0u;
    sync();
    for (uint k = lane; k < n; k += LANES) {
        if (live(k) && (nextOf(k) == NO_INDEX || previousOf(k) == NO_INDEX)) cleared = 1u;
    }
    sync();
    bool gaps = cleared != 0u;
    sync();
    return gaps;
}

// The loop of each node: its lowest node, by pointer jumping.
void labelLoops(uint lane, uint n) {
    for (uint k = lane; k < n; k += LANES) {
        rings[base + k].z = k;
        rings[base + k].w = live(k) ? nextOf(k) : k;
    }
    sync();
    for (uint reach = 1u; reach < 2u * MAX_SEGMENTS; reach <<= 1) {
        uvec2 fresh[TURNS];
        for (uint k = lane, turn_ = 0u; k < n; k += LANES, turn_++) {
            uvec2 mine = rings[base + k].zw, far = rings[base + min(mine.y, n - 1u)].zw;
            fresh[turn_] = uvec2(min(mine.x, far.x), far.y);
        }
        sync();
        for (uint k = lane, turn_ = 0u; k < n; k += LANES, turn_++) rings[base + k].zw = fresh[turn_];
        sync();
    }
}

// Area and rightmost corner of every loop; lists the loops by what they are.
void measureLoops(uint lane, uint n) {
    if (lane == 0u) {
        hole_total = 0u;
        outer_total = 0u;
        node_total = n;
    }
    sync();
    for (uint k = lane; k < n; k += LANES) {
        bool first = live(k) && rings[base + k].z == k;
        int64_t area = int64_t(0);
        uint rightmost = k, walk = k;
        ivec2 origin = at(k);
        for (uint step = 0u; step < n && first; step++) {
            uint next = nextOf(walk);
            area += doubleArea(origin, at(walk), at(next));
            ivec2 p = at(next), r = at(rightmost);
            if (p.x > r.x || (p.x == r.x && p.y > r.y)) rightmost = next;
            walk = next;
            if (walk == k) break;
        }
        loops[base + k] = ivec4(signOf(area) > 0 ? 1 : -1, int(rightmost), 0, 0);
        if (first && signOf(area) > 0) {
            uint s = atomicAdd(outer_total, 1u);
            if (s < MAX_LOOPS) outers[s] = k;
        }
        if (first && signOf(area) <= 0) {
            uint s = atomicAdd(hole_total, 1u);
            if (s < MAX_LOOPS) holes[s] = k;
        }
    }
    sync();
}
