// Holes of a cap are joined to the loop around them by bridges. Wants lib/cap_loops.glsl.

bool rightOf(uint a, uint b) { // loop a reaches further right than loop b
    ivec2 p = at(uint(loops[base + a].y)), q = at(uint(loops[base + b].y));
    return p.x != q.x ? p.x > q.x : (p.y != q.y ? p.y > q.y : a < b);
}

// Holes from right to left, each with the smallest outer loop around it: the one hit first, going left to right, by a ray
// to the right from its rightmost corner, whose loop is not a hole's, or the loop that this hole in turn is joined to.
void orderHoles(uint lane) {
    uint total = min(hole_total, uint(MAX_LOOPS)), mine[MAX_LOOPS / LANES + 1], rank[MAX_LOOPS / LANES + 1];
    for (uint h = lane, turn_ = 0u; h < total; h += LANES, turn_++) {
        mine[turn_] = holes[h];
        rank[turn_] = 0u;
        for (uint g = 0u; g < total; g++) rank[turn_] += rightOf(holes[g], holes[h]) ? 1u : 0u;
    }
    barrier();
    for (uint h = lane, turn_ = 0u; h < total; h += LANES, turn_++) holes[rank[turn_]] = mine[turn_];
    barrier();
}

// Lowest key over all lanes; its pick in lane_pick[0].
void reduceLowest(uint lane, int64_t key, uint pick) {
    lane_key[lane] = key;
    lane_pick[lane] = pick;
    barrier();
    for (uint width = LANES / 2u; width > 0u; width >>= 1) {
        if (lane < width) {
            bool lower = lane_key[lane + width] < lane_key[lane] ||
                         (lane_key[lane + width] == lane_key[lane] && lane_pick[lane + width] < lane_pick[lane]);
            if (lower) {
                lane_key[lane] = lane_key[lane + width];
                lane_pick[lane] = lane_pick[lane + width];
            }
        }
        barrier();
    }
}

const int64_t kFar = int64_t(0x3fffffff) << 32;

// The first upward edge to the right of corner m: the solid lies between. Edges of the hole itself do not count, and of a
// corner that the ray meets only the edge above, unless nothing else is met: then m touches the top of an outline.
void hitEdge(uint lane, uint m, uint hole, bool tops_too) {
    ivec2 p = at(m);
    int64_t key = kFar;
    uint pick = NO_INDEX;
    for (uint k = lane; k < node_total; k += LANES) {
        ivec2 a = at(k), b = live(k) ? at(nextOf(k)) : a;
        bool spans = live(k) && a.y <= p.y && (p.y < b.y || (tops_too && p.y == b.y && a.y < b.y)) && rings[base + k].z != hole;
        int64_t rise = int64_t(max(b.y - a.y, 1));
        int64_t x = int64_t(a.x) + int64_t(p.y - a.y) * int64_t(b.x - a.x) / rise;
        bool right = turn(a, b, p) >= 0;
        if (spans && right && (x < key || (x == key && k < pick))) {
            key = x;
            pick = k;
        }
    }
    reduceLowest(lane, key, pick);
}

// Whether corner a leaves the ray to the right from p less than corner b does; of those in one line, or where there is no ray
// to follow (`lost`), the nearer.
bool closerToRay(uint a, uint b, ivec2 p, bool lost) {
    if (a == NO_INDEX || b == NO_INDEX) return a != NO_INDEX;
    ivec2 u = abs(at(a) - p), w = abs(at(b) - p);
    int64_t side = int64_t(u.y) * int64_t(w.x) - int64_t(w.y) * int64_t(u.x);
    int64_t far_u = int64_t(u.x) + int64_t(u.y), far_w = int64_t(w.x) + int64_t(w.y);
    bool nearer = far_u != far_w ? far_u < far_w : a < b;
    return lost || isZero(side) ? nearer : isNegative(side);
}

// Of the loop's corners in the triangle (m, point hit, end of the edge hit), the one that leaves the ray least, in
// lane_pick[0]. Where the ray was lost, the nearest corner of any other loop: rounding has put m just outside of its outline,
// and what the bridge then crosses is no wider than that.
void visibleCorner(uint lane, uint m, uint loop, ivec2 hit, uint end, bool lost) {
    ivec2 p = at(m), c = at(end);
    bool above = c.y > p.y;
    uint pick = NO_INDEX;
    for (uint k = lane; k < node_total; k += LANES) {
        ivec2 q = at(k);
        bool ours = live(k) && (rings[base + k].z == loop) != lost;
        bool inside = ours && q.x >= p.x && inTriangle(p, above ? hit : c, above ? c : hit, q);
        inside = (ours && lost) || (inside && (q == p || inCone(at(previousOf(k)), q, at(nextOf(k)), p)));
        pick = inside && closerToRay(k, pick, p, lost) ? k : pick;
    }
    lane_pick[lane] = pick;
    barrier();
    for (uint width = LANES / 2u; width > 0u; width >>= 1) {
        if (lane < width && closerToRay(lane_pick[lane + width], lane_pick[lane], p, lost)) lane_pick[lane] = lane_pick[lane + width];
        barrier();
    }
}

void bridgeHoles(uint lane) {
    uint total = min(hole_total, uint(MAX_LOOPS));
    for (uint h = 0u; h < total; h++) {
        uint hole = holes[h], m = uint(loops[base + hole].y);
        uint edge = NO_INDEX;
        int x = 0;
        for (uint attempt = 0u; attempt < ROLLED(2) && edge == NO_INDEX; attempt++) {
            hitEdge(lane, m, hole, attempt == 1u);
            edge = lane_pick[0];
            x = int(clamp(lane_key[0], -int64_t(0x7ffffff0), int64_t(0x7ffffff0)));
            barrier();
        }
        bool lost = edge == NO_INDEX;
        uint follow = lost ? 0u : nextOf(edge), end = !lost && at(edge).x > at(follow).x ? edge : follow;
        visibleCorner(lane, m, lost ? hole : rings[base + edge].z, ivec2(x, at(m).y), end, lost);
        uint corner = lane_pick[0] == NO_INDEX ? end : lane_pick[0];
        bool found = !lost || lane_pick[0] != NO_INDEX;
        uint loop = rings[base + corner].z;
        barrier();
        if (found && lane == 0u) {
            uint m2 = node_total, c2 = node_total + 1u, after = nextOf(corner), before = previousOf(m);
            nodes[base + m2] = nodes[base + m];
            nodes[base + c2] = nodes[base + corner];
            rings[base + m2] = uvec4(c2, before, loop, 0u);
            rings[base + c2] = uvec4(after, m2, loop, 0u);
            rings[base + corner].x = m;
            rings[base + m].y = corner;
            rings[base + before].x = m2;
            rings[base + after].y = c2;
            node_total += 2u;
        }
        sync();
        for (uint k = lane; k < node_total; k += LANES) {
            if (found && rings[base + k].z == hole) rings[base + k].z = loop;
        }
        sync();
    }
}
