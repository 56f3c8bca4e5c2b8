// Triangulates any cap, a workgroup a face: opposite edges cancel, the rest is chained into loops (at a shared corner by the
// sharpest left turn), holes are joined to the loop around them by bridges, and ears are clipped many at a time.
//
// Whatever the rounding of corners does, the outcome is closed: each step of ear clipping keeps the directed boundary, so
// n corners and h holes give n - 2 + 2h triangles whose outline is the input's. Only looks can suffer, and triangles that
// come out turned over are counted.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/precision.glsl"

#ifndef LANES
#define LANES 64
#define MAX_SEGMENTS LARGE_FACE
#define LIST_COUNT COUNT_LARGE_FACES
#endif
#define MAX_NODES (2 * MAX_SEGMENTS)
#define TURNS (MAX_NODES / LANES)
#define MAX_LOOPS 256
layout(local_size_x = LANES) in;
UPDATES(0, uint, counts);
READS(1, ivec4, sites);
READS(2, uint, faces);
READS(3, uint, neighbors);
READS(4, uint, face_cells);
READS(5, uint, face_offsets);
READS(6, uvec4, segments);
READS(7, uint, welded);
READS(8, uint, points);
WRITES(9, uint, loose_caps);
WRITES(10, uint, cap_counts);
READS(11, uint, large_faces);
layout(set = 0, binding = 12, std430) coherent buffer nodes_block { ivec4 nodes[]; }; // x, y, name, state
layout(set = 0, binding = 13, std430) coherent buffer rings_block { uvec4 rings[]; }; // next, previous, loop, scratch
layout(set = 0, binding = 14, std430) coherent buffer loops_block { ivec4 loops[]; }; // of a loop's first node: turns left?, rightmost
// While ears are clipped, `loops` has the list of corners to be tested, whether somebody is in the way, the list of those that are
// left, and who was in the way the last time.
READS(15, uint, cap_slots);
#include "lib/cap_plane.glsl"

// Of the 65,535 loop turns that Mesa's software device allows, those for clipping ears.
const uint kClipTurns = 46000u;

#define DEAD 0
#define ALIVE 1
#define EAR 2

shared uint reflex_list[MAX_NODES];
shared uint outers[MAX_LOOPS];
shared uint holes[MAX_LOOPS];
shared uint lane_pick[LANES];
shared int64_t lane_key[LANES];
shared uint node_total, alive_total, test_total, reflex_total, spike_total, cleared, hole_total, outer_total;
shared int round_total;

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

// Which of two ways out turns further left, looking back along the way in: 0 right of back ... 3 back itself.
int sectorOf(ivec2 back, ivec2 d) {
    int64_t cross_ = int64_t(back.x) * int64_t(d.y) - int64_t(back.y) * int64_t(d.x);
    int64_t dot_ = int64_t(back.x) * int64_t(d.x) + int64_t(back.y) * int64_t(d.y);
    return isNegative(cross_) ? 0 : (signOf(cross_) > 0 ? 2 : (isNegative(dot_) ? 1 : 3));
}

bool furtherLeft(ivec2 back, ivec2 a, ivec2 b) {
    int sa = sectorOf(back, a), sb = sectorOf(back, b);
    return sa != sb ? sa < sb : isNegative(int64_t(a.x) * int64_t(b.y) - int64_t(a.y) * int64_t(b.x));
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

bool inCone(ivec2 before, ivec2 c, ivec2 after, ivec2 x) {
    bool convex = turn(before, c, after) >= 0;
    ivec2 first = convex ? before : after, second = convex ? after : before;
    bool between = turn(c, x, first) >= 0 && turn(c, second, x) >= 0;
    return convex ? between : !between;
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

// Whether x lies left of a b by more than rounding explains.
bool clearlyLeft(ivec2 a, ivec2 b, ivec2 x) { return signOf(doubleArea(a, b, x) - kTouch * reach(a, b)) > 0; }

// Of corners that only seem to be in the way: an ear, or a tip that is turned over, but for rounding.
bool isEarButForRounding(ivec2 a, ivec2 b, ivec2 c) { return signOf(doubleArea(a, b, c) + kTouch * reach(a, c)) > 0; }

bool clearlyIn(ivec2 a, ivec2 b, ivec2 c, ivec2 x) { return clearlyLeft(a, b, x) && clearlyLeft(b, c, x) && clearlyLeft(c, a, x); }

// Whether x lies in the triangle or touches it but for rounding. Ears that nothing touches go first: where the outline touches
// itself, a corner may lie just outside of an ear that has the rest of the outline behind it.
bool touches(ivec2 a, ivec2 b, ivec2 c, ivec2 x) { return !clearlyLeft(b, a, x) && !clearlyLeft(c, b, x) && !clearlyLeft(a, c, x); }

bool entersEar(uint q, ivec2 a, ivec2 b, ivec2 c, bool touching) {
    ivec2 x = at(q);
    if (x != a && x != b && x != c) {
        return touching ? touches(a, b, c, x) : inTriangle(a, b, c, x);
    }
    // A second visit of one of the ear's corners blocks only if its own edges enter the ear.
    ivec2 from = x == a ? c : (x == b ? a : b), to = x == a ? b : (x == b ? c : a);
    ivec2 p = at(previousOf(q)), n = at(nextOf(q));
    return (turn(from, x, p) > 0 && turn(x, to, p) > 0) || (turn(from, x, n) > 0 && turn(x, to, n) > 0);
}

// Whether loops go round more or less often than once: where walls of the surface have passed through each other, the strip
// between them is there twice, and its end, which would be reflex, turns left.
bool goesRoundOften(uint lane) {
    if (lane == 0u) round_total = 0;
    barrier();
    for (uint k = lane; k < node_total; k += LANES) {
        if (live(k)) atomicAdd(round_total, roundTurn(at(previousOf(k)), at(k), at(nextOf(k))));
    }
    barrier();
    return round_total != int(outer_total);
}

bool entersOther(uint q, uint p, uint k, uint s, uint phase) {
    bool other = q != p && q != k && q != s && rings[base + q].z == rings[base + k].z;
    ivec2 a = at(p), b = at(k), c = at(s);
    return other && (phase < 3u ? entersEar(q, a, b, c, phase == 0u) : clearlyIn(a, b, c, at(q)));
}

// Whether a corner is in the list of those that are looked at, and enters the ear.
bool isInTheWay(uint q, uint p, uint k, uint s, uint phase, bool wary) {
    bool listed = live(q) && nextOf(q) != previousOf(q) && (wary || turn(at(previousOf(q)), at(q), at(nextOf(q))) <= 0);
    return listed && entersOther(q, p, k, s, phase);
}

uint priorityOf(uint k) { return (k * 0x9e3779b1u) ^ (k >> 7); }

void main() {
    uint lane = gl_LocalInvocationID.x;
    bool failed = counts[STATUS_FAILED] != 0u;
    uint index = large_faces[min(flatGroup(), max(counts[LIST_COUNT], 1u) - 1u)];
    index = failed ? 0u : index;
    uint f = faces[index], first = face_offsets[f], n = failed ? 0u : face_offsets[f + 1u] - first;
    if (n > MAX_SEGMENTS) {
        if (lane == 0u) {
            atomicAdd(counts[STATUS_BAD_CAP], 1u);
            cap_counts[index] = 0u;
        }
        n = 0u;
    }
    CapPlane plane = capPlane(sites[face_cells[f]].xyz, sites[neighbors[f]].xyz);
    slots = cap_slots[index];
    base = slots - counts[COUNT_SEGMENTS];
    plane_u = plane.u;
    plane_w = plane.w;
    for (uint k = lane; k < 2u * n; k += LANES) {
        loose_caps[3u * (slots + k)] = NO_INDEX;
        nodes[base + k] = ivec4(0);
    }
    sync();
    loadEdges(lane, first, n);
    chainEdges(lane, n);
    if (!kExact && hasGaps(lane, n)) {
        if (lane == 0u) {
            atomicAdd(counts[STATUS_OPEN_OUTLINES], 1u);
            atomicOr(counts[STATUS_FAILED], FAILED_CLIP);
            cap_counts[index] = 0u;
        }
        n = 0u;
    }
    labelLoops(lane, n);
    measureLoops(lane, n);
    if (lane == 0u && (hole_total > MAX_LOOPS || outer_total > MAX_LOOPS)) atomicAdd(counts[STATUS_BAD_CAP], 1u);
    orderHoles(lane);
    bridgeHoles(lane);

    uint phase = 0u, made = 0u, budget = kClipTurns, turns = 5u * (node_total / LANES + 1u);
    // Corners that turn left cannot be the first to enter an ear, unless the outline crosses itself.
    bool wary = goesRoundOften(lane), finished = n == 0u;
    for (uint k = lane; k < node_total; k += LANES) loops[base + k].w = int(k);
    for (uint round = 0u; round < kClipTurns && !finished && budget > turns; round++) {
        budget -= turns;
        if (lane == 0u) {
            reflex_total = 0u;
            spike_total = 0u;
            test_total = 0u;
            alive_total = 0u;
            cleared = 0u;
        }
        barrier();
        for (uint k = lane; k < node_total; k += LANES) {
            if (live(k)) {
                nodes[base + k].w = ALIVE;
                if (nextOf(k) == previousOf(k) || nextOf(k) == k) {
                    rings[base + k].w = 1u; // two corners left: nothing between them
                } else {
                    rings[base + k].w = 0u;
                    loops[base + atomicAdd(alive_total, 1u)].z = int(k);
                    ivec2 a = at(previousOf(k)), b = at(k), c = at(nextOf(k));
                    if (wary || turn(a, b, c) <= 0) reflex_list[atomicAdd(reflex_total, 1u)] = k;
                    if (isSpike(a, b, c)) atomicAdd(spike_total, 1u);
                }
            }
        }
        sync();
        finished = alive_total == 0u;
        // From the list of those that are left: lanes of corners that are gone would wait for the others.
        for (uint i = lane; i < alive_total; i += LANES) {
            uint k = uint(loops[base + i].z), p = previousOf(k), s = nextOf(k);
            ivec2 a = at(p), b = at(k), c = at(s);
            int size = turn(a, b, c);
            // Spikes go before ears: where a hole fills its outline, or runs along it, all of that is spikes, one after the
            // other, while its ears seem to be there twice.
            bool spikes = spike_total != 0u;
            bool nearly = phase == 3u && isEarButForRounding(a, b, c);
            bool test = (size > 0 || nearly) && phase < 4u && !spikes;
            bool ear = spikes ? isSpike(a, b, c) : size > 0 || nearly || (phase >= 2u && size == 0) || phase >= 5u;
            // Who was in the way the last time still is, most often.
            if (test && ear && !isInTheWay(uint(loops[base + k].w), p, k, s, phase, wary)) {
                loops[base + atomicAdd(test_total, 1u)].x = int(k);
                loops[base + k].y = 0;
            } else if (ear && !test) {
                nodes[base + k].w = EAR;
            }
        }
        sync();
        // All lanes share the looks: where a ring is left between two loops, a few ears are new in a round, and many rounds follow.
        uint looks = test_total * reflex_total;
        bool affordable = looks / LANES + 1u < budget;
        for (uint j = lane; j < looks && affordable; j += LANES) {
            uint k = uint(loops[base + j / max(reflex_total, 1u)].x), q = reflex_list[j % max(reflex_total, 1u)];
            if (entersOther(q, previousOf(k), k, nextOf(k), phase)) {
                loops[base + k].y = 1;
                loops[base + k].w = int(q);
            }
        }
        budget = affordable ? budget - looks / LANES - 1u : 0u;
        sync();
        for (uint c = lane; c < test_total && affordable; c += LANES) {
            uint k = uint(loops[base + c].x);
            if (loops[base + k].y == 0) nodes[base + k].w = EAR;
        }
        sync();
        for (uint k = lane; k < node_total; k += LANES) {
            if (nodes[base + k].w == EAR) {
                uint p = previousOf(k), s = nextOf(k);
                bool yields = (nodes[base + p].w == EAR && priorityOf(p) < priorityOf(k)) ||
                              (nodes[base + s].w == EAR && priorityOf(s) < priorityOf(k));
                if (!yields) rings[base + k].w = 2u;
            }
        }
        sync();
        for (uint k = lane; k < node_total; k += LANES) {
            uint verdict = live(k) ? rings[base + k].w : 0u;
            if (verdict == 2u) {
                uint p = previousOf(k), s = nextOf(k);
                saveCap(slots + k, p, k, s);
                if (turn(at(p), at(k), at(s)) < 0) atomicAdd(counts[STATUS_TURNED_OVER], 1u);
                rings[base + p].x = s;
                rings[base + s].y = p;
                atomicAdd(cleared, 1u);
            }
            if (verdict != 0u) nodes[base + k].w = DEAD;
        }
        sync();
        made += cleared;
        phase = cleared == 0u ? min(phase + 1u, 5u) : 0u;
        barrier();
    }
    if (lane == 0u && n > 0u) cap_counts[index] = made;
    if (lane == 0u && !finished) atomicAdd(counts[STATUS_BAD_CAP], 1u);
}
