// Ears of a cap's loops are clipped, many in a round. Wants lib/cap_holes.glsl.
//
// While that goes on `loops` has, by place in a list, x: the corners to be tested, z: those that are left; and by corner, y: whether
// somebody is in the way, w: who was the last time, who most often still is.

// Of the 65,535 loop turns that Mesa's software device allows, those for clipping ears.
const uint kClipTurns = 46000u;
shared uint reflex_list[MAX_NODES];
shared uint alive_total, test_total, reflex_total, spike_total;
shared int round_total;

uint phase; // how much is overlooked, since nothing else was found: 0 nothing ... 5 everything
bool wary;  // the outline crosses itself

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

bool entersOther(uint q, uint p, uint k, uint s) {
    bool other = q != p && q != k && q != s && rings[base + q].z == rings[base + k].z;
    ivec2 a = at(p), b = at(k), c = at(s);
    return other && (phase < 3u ? entersEar(q, a, b, c, phase == 0u) : clearlyIn(a, b, c, at(q)));
}

// Whether a corner is in the list of those that are looked at, and enters the ear.
bool isInTheWay(uint q, uint p, uint k, uint s) {
    bool listed = live(q) && nextOf(q) != previousOf(q) && (wary || turn(at(previousOf(q)), at(q), at(nextOf(q))) <= 0);
    return listed && entersOther(q, p, k, s);
}

uint priorityOf(uint k) { return (k * 0x9e3779b1u) ^ (k >> 7); }

// Lists the corners that are left, and of them those that may be in the way of others.
void listCorners(uint lane) {
    if (lane == 0u) {
        reflex_total = 0u;
        spike_total = 0u;
        test_total = 0u;
        alive_total = 0u;
        cleared = 0u;
    }
    barrier();
    for (uint k = lane; k < node_total; k += LANES) {
        if (!live(k)) continue;
        nodes[base + k].w = ALIVE;
        bool done = nextOf(k) == previousOf(k) || nextOf(k) == k; // two corners left: nothing between them
        rings[base + k].w = done ? 1u : 0u;
        if (done) continue;
        loops[base + atomicAdd(alive_total, 1u)].z = int(k);
        ivec2 a = at(previousOf(k)), b = at(k), c = at(nextOf(k));
        if (wary || turn(a, b, c) <= 0) reflex_list[atomicAdd(reflex_total, 1u)] = k;
        if (isSpike(a, b, c)) atomicAdd(spike_total, 1u);
    }
    sync();
}

// From the list of corners that are left: lanes of corners that are gone would wait for the others. Spikes go before ears: where
// a hole fills its outline, or runs along it, all of that is spikes, one after the other, while its ears seem to be there twice.
void proposeEars(uint lane) {
    bool spikes = spike_total != 0u;
    for (uint i = lane; i < alive_total; i += LANES) {
        uint k = uint(loops[base + i].z), p = previousOf(k), s = nextOf(k);
        ivec2 a = at(p), b = at(k), c = at(s);
        int size = turn(a, b, c);
        bool nearly = phase == 3u && isEarButForRounding(a, b, c);
        bool test = (size > 0 || nearly) && phase < 4u && !spikes;
        bool ear = spikes ? isSpike(a, b, c) : size > 0 || nearly || (phase >= 2u && size == 0) || phase >= 5u;
        if (test && ear && !isInTheWay(uint(loops[base + k].w), p, k, s)) {
            loops[base + atomicAdd(test_total, 1u)].x = int(k);
            loops[base + k].y = 0;
        } else if (ear && !test) {
            nodes[base + k].w = EAR;
        }
    }
    sync();
}

// All lanes share the looks: where a ring is left between two loops, a few ears are new in a round, and many rounds follow.
void lookAround(uint lane, uint looks, uint tests) {
    for (uint j = lane; j < looks; j += LANES) {
        uint k = uint(loops[base + j / max(reflex_total, 1u)].x), q = reflex_list[j % max(reflex_total, 1u)];
        if (entersOther(q, previousOf(k), k, nextOf(k))) {
            loops[base + k].y = 1;
            loops[base + k].w = int(q);
        }
    }
    sync();
    for (uint c = lane; c < tests; c += LANES) {
        uint k = uint(loops[base + c].x);
        if (loops[base + k].y == 0) nodes[base + k].w = EAR;
    }
    sync();
}

// Of neighbors only one can go.
void chooseEars(uint lane) {
    for (uint k = lane; k < node_total; k += LANES) {
        if (nodes[base + k].w == EAR) {
            uint p = previousOf(k), s = nextOf(k);
            bool yields = (nodes[base + p].w == EAR && priorityOf(p) < priorityOf(k)) ||
                          (nodes[base + s].w == EAR && priorityOf(s) < priorityOf(k));
            if (!yields) rings[base + k].w = 2u;
        }
    }
    sync();
}

void cutEars(uint lane) {
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
}

// How many triangles that makes; all corners are gone unless the loop turns run out first.
uint clipEars(uint lane, out bool finished) {
    uint made = 0u, budget = kClipTurns, turns = 5u * (node_total / LANES + 1u);
    wary = goesRoundOften(lane);
    phase = 0u;
    finished = node_total == 0u;
    bool affordable = true;
    for (uint k = lane; k < node_total; k += LANES) loops[base + k].w = int(k);
    for (uint round = 0u; round < kClipTurns && !finished && affordable; round++) {
        listCorners(lane);
        finished = alive_total == 0u;
        proposeEars(lane);
        uint looks = test_total * reflex_total;
        uint cost = turns + looks / LANES + 1u;
        affordable = cost < budget;
        budget -= min(budget, cost);
        lookAround(lane, affordable ? looks : 0u, affordable ? test_total : 0u);
        chooseEars(lane);
        cutEars(lane);
        made += cleared;
        phase = cleared == 0u ? min(phase + 1u, 5u) : 0u;
        barrier();
    }
    return made;
}
