// Box Cutting (the paper, section 3) with a filter: one lane builds one cell in fp32, and stops where an answer is not certain.
//
// Lanes of a subgroup take sites of neighboring bins. Walls of the box are mirrored sites, so that every plane is a bisector
// d.w <= d.d, with d the way to the other site (exact in fp32) and w = 2 (v - site). Each corner keeps w and a bound of its
// error; a test that does not clear the bounds (roundoff 2^-23 an operation, since Vulkan fixes no rounding mode; contraction
// only helps) queues the cell for the exact kernel, and so does running out of planes, corners or turns.
//
// An `if` is no saving where lanes run in step: the search for a bisector that cuts is a loop of its own, cutting another.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

#define PLANES RAW_PLANES
#define CORNERS 64
#define LIST 64
FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, bin_start);
READS(2, ivec4, bin_sites);
WRITES(3, uint, raw);
WRITES(4, uvec2, cell_raw);
layout(push_constant) uniform Push {
    ivec4 bins; // w: edge of a bin
    ivec4 box_low;
    ivec4 box_high;
    uint slots;
};

const float kRoundoff = 1.0 / 8388608.0;
const float kCornerError = 12.0 * kRoundoff;
const float kTestError = 8.0 * kRoundoff;
const uint kNoKey = 0xffffffffu;
const float kMaxRelativeError = 1e-3;
// Loop turns of one lane. Lanes that run in step may each spend theirs at different times, and Mesa's software device stops
// a subgroup (8 lanes, 16 at most) without a word at 65,535: an eighth of that is safe, and three times what a usual cell takes.
const uint kTurnBudget = 7900u;

vec3 plane[PLANES];
uint plane_id[PLANES];
int rim[PLANES];
vec4 corner[CORNERS]; // w and its error bound; zero where free
uint triple[CORNERS];
uint key[LIST];       // squared distance, its last bits replaced by the place in the list
uint listed[LIST];    // place in bin_sites
uint free_low, free_high, top, plane_count, status;
float reach;

uint takeFree() {
    bool low = free_low != 0u;
    uint word = low ? free_low : free_high;
    uint slot = word == 0u ? CORNERS - 1u : uint(findLSB(word)) + (low ? 0u : 32u);
    status = word == 0u ? CELL_OVERFLOW : status;
    free_low = low ? free_low & (free_low - 1u) : 0u;
    free_high = low ? free_high : free_high & (free_high - 1u);
    top = max(top, slot + 1u);
    return slot;
}

void makeCorner(uint slot, uint a, uint b, uint c) {
    vec3 pa = plane[a], pb = plane[b], pc = plane[c];
    vec3 bc = cross(pb, pc), ca = cross(pc, pa), ab = cross(pa, pb);
    float la = length(pa), lb = length(pb), lc = length(pc);
    float inverse = 1.0 / dot(pa, bc);
    vec3 w = (dot(pa, pa) * bc + dot(pb, pb) * ca + dot(pc, pc) * ab) * inverse;
    float size = length(w);
    float error = kCornerError * la * lb * lc * abs(inverse) * (la + lb + lc + size) + kTestError * (abs(w.x) + abs(w.y) + abs(w.z));
    if (!(error < kMaxRelativeError * size)) status = CELL_UNDECIDED;
    corner[slot] = vec4(w, error);
    triple[slot] = a | (b << 8) | (c << 16);
}

void measureReach() {
    float furthest = 0.0;
    for (uint k = 0u; k < top; k++) furthest = max(furthest, dot(corner[k].xyz, corner[k].xyz));
    reach = furthest * (1.0 + 4.0 * kMaxRelativeError);
}

void startFromBox(ivec3 site) {
    for (uint k = 0u; k < ROLLED(CORNERS); k++) {
        corner[k] = vec4(0.0);
        triple[k] = 0u;
    }
    for (uint k = 0u; k < ROLLED(PLANES); k++) rim[k] = 0;
    for (uint k = 0u; k < ROLLED(LIST); k++) key[k] = kNoKey;
    vec3 low = vec3(2 * (box_low.xyz - site)), high = vec3(2 * (box_high.xyz - site));
    for (uint k = 0u; k < ROLLED(3); k++) {
        vec3 axis = vec3(k == 0u ? 1.0 : 0.0, k == 1u ? 1.0 : 0.0, k == 2u ? 1.0 : 0.0);
        plane[2u * k] = axis * low;
        plane[2u * k + 1u] = axis * high;
        plane_id[2u * k] = BOX_BASE + 2u * k;
        plane_id[2u * k + 1u] = BOX_BASE + 2u * k + 1u;
    }
    plane_count = 6u;
    free_low = ~255u;
    free_high = ~0u;
    top = 8u;
    for (uint k = 0u; k < ROLLED(8); k++) {
        uint x = k & 1u, y = 2u + ((k >> 1) & 1u), z = 4u + (k >> 2);
        bool odd = ((k ^ (k >> 1) ^ (k >> 2)) & 1u) != 0u;
        makeCorner(k, x, odd ? y : z, odd ? z : y);
    }
    measureReach();
}

// Most that any corner may stick out over plane e.
float furthestOver(vec3 e, float size) {
    float furthest = 0.0;
    for (uint k = 0u; k < top; k++) furthest = max(furthest, dot(e, corner[k].xyz) + size * corner[k].w);
    return furthest;
}

uint nearestListed(uint count) {
    uint nearest = kNoKey;
    for (uint k = 0u; k < count; k += 8u) {
        uint a = min(min(key[k], key[k + 1u]), min(key[k + 2u], key[k + 3u]));
        uint b = min(min(key[k + 4u], key[k + 5u]), min(key[k + 6u], key[k + 7u]));
        nearest = min(nearest, min(a, b));
    }
    return nearest;
}

int weigh(uint p) { return int(p) + 256 * int(p * p); }

void addToRim(uint t) {
    uint a = triple[t] & 255u, b = (triple[t] >> 8) & 255u, c = triple[t] >> 16;
    int wa = weigh(a), wb = weigh(b), wc = weigh(c);
    rim[a] += wb - wc;
    rim[b] += wc - wa;
    rim[c] += wa - wb;
}

// What is left on a rim plane is next - prev + 256 (next^2 - prev^2).
uint nextOnRim(int sum) {
    int difference = (sum << 24) >> 24;
    int squares = (sum - difference) >> 8;
    int total = int(roundEven(float(squares) / float(difference)));
    return uint((total + difference) >> 1) & 63u;
}

void cutBy(vec3 e, uint id) {
    float size = length(e), square = dot(e, e);
    float sure_out = square * (1.0 + kTestError), sure_in = square * (1.0 - kTestError);
    uint gone_low = 0u, gone_high = 0u;
    bool unsure = false;
    for (uint k = 0u; k < top; k++) {
        float q = dot(e, corner[k].xyz), slack = size * corner[k].w;
        bool out_ = q - slack > sure_out;
        unsure = unsure || (!out_ && q + slack >= sure_in);
        uint bit = out_ ? 1u << (k & 31u) : 0u;
        gone_low |= k < 32u ? bit : 0u;
        gone_high |= k < 32u ? 0u : bit;
    }
    if (unsure) status = CELL_UNDECIDED;
    if (plane_count + 1u >= PLANES) status = CELL_OVERFLOW;
    bool any_ = (gone_low | gone_high) != 0u && status == CELL_OK;
    gone_low = any_ ? gone_low : 0u;
    gone_high = any_ ? gone_high : 0u;
    uint start = 0u, low = gone_low, high = gone_high;
    for (uint k = 0u; k < CORNERS && (low | high) != 0u; k++) {
        bool lower = low != 0u;
        uint t = lower ? uint(findLSB(low)) : 32u + uint(findLSB(high));
        low = lower ? low & (low - 1u) : 0u;
        high = lower ? high : high & (high - 1u);
        addToRim(t);
    }
    low = gone_low;
    high = gone_high;
    for (uint k = 0u; k < CORNERS && (low | high) != 0u; k++) {
        bool lower = low != 0u;
        uint t = lower ? uint(findLSB(low)) : 32u + uint(findLSB(high));
        low = lower ? low & (low - 1u) : 0u;
        high = lower ? high : high & (high - 1u);
        uint a = triple[t] & 255u, b = (triple[t] >> 8) & 255u, c = triple[t] >> 16;
        start = rim[a] != 0 ? a : (rim[b] != 0 ? b : (rim[c] != 0 ? c : start));
        corner[t] = vec4(0.0);
    }
    free_low |= gone_low;
    free_high |= gone_high;
    if (any_) {
        plane[plane_count] = e;
        plane_id[plane_count] = id;
    }
    uint at = start;
    bool open = any_;
    for (uint k = 0u; k < PLANES && open; k++) {
        int sum = rim[at];
        uint next = sum != 0 ? nextOnRim(sum) : start;
        rim[at] = 0;
        if (sum == 0) status = CELL_UNDECIDED;
        makeCorner(takeFree(), at, next, plane_count);
        at = next;
        open = at != start && status == CELL_OK;
    }
    plane_count += any_ ? 1u : 0u;
    measureReach();
}

float ringDistance(ivec3 site, ivec3 home, int ring) {
    ivec3 below = site - box_low.xyz - (home - ring) * bins.w, above = (home + ring + 1) * bins.w - (site - box_low.xyz);
    float least = 1e30;
    for (int k = 0; k < 3; k++) {
        least = home[k] - ring > 0 ? min(least, float(below[k])) : least;
        least = home[k] + ring + 1 < bins[k] ? min(least, float(above[k])) : least;
    }
    return least;
}

void main() {
    uint lane = flatIndex();
    uint count_sites = counts[COUNT_SITES];
    if (lane >= min(slots, count_sites)) return;
    ivec4 own = bin_sites[lane];
    ivec3 site = own.xyz, home = min((own.xyz - box_low.xyz) / bins.w, bins.xyz - 1);
    status = CELL_OK;
    startFromBox(site);

    int ring = 1;
    uint row = 0u, at = 0u, row_end = 0u, budget = kTurnBudget;
    bool finished = false;
    for (uint turn = 0u; turn < 512u && !finished; turn++) {
        // Fill the list with sites of this ring that may still cut; a turn is a site or a new row.
        int width = 2 * ring + 1;
        uint rows = ring == 1 ? 9u : uint(2 * width * width), count = 0u;
        for (uint guard = 0u; guard < 4096u && count < LIST && budget > 0u && (row < rows || at < row_end); guard++) {
            bool step_row = at >= row_end;
            uint line = ring == 1 ? row : row >> 1;
            int y = home.y + int(line) % width - ring, z = home.z + int(line) / width - ring;
            bool whole = ring == 1 || abs(y - home.y) == ring || abs(z - home.z) == ring, right = ring != 1 && (row & 1u) != 0u;
            int x0 = whole || !right ? home.x - ring : home.x + ring, x1 = whole ? home.x + ring : x0;
            bool inside = y >= 0 && y < bins.y && z >= 0 && z < bins.z && x1 >= 0 && x0 < bins.x && !(whole && right);
            uint first = inside ? uint((z * bins.y + y) * bins.x) : 0u;
            uint begin = bin_start[inside ? first + uint(max(x0, 0)) : 0u], end = bin_start[inside ? first + uint(min(x1, bins.x - 1)) + 1u : 0u];
            at = step_row ? (inside ? begin : 0u) : at;
            row_end = step_row ? (inside ? end : 0u) : row_end;
            row += step_row ? 1u : 0u;
            bool is_site = at < row_end;
            ivec4 q = bin_sites[is_site ? at : lane];
            vec3 d = vec3(q.xyz - site);
            float distance = dot(d, d);
            if (is_site && at != lane && distance <= reach) {
                key[count] = (floatBitsToUint(distance) & ~63u) | count;
                listed[count] = at;
                count++;
            }
            at += is_site ? 1u : 0u;
            budget -= min(budget, 1u);
        }
        bool ring_done = row >= rows && at >= row_end;
        // Cut by what is listed, near to far.
        bool drained = count == 0u;
        for (uint step = 0u; step < 96u && !drained; step++) {
            vec3 e = vec3(0.0);
            uint id = 0u;
            bool found = false;
            for (uint search = 0u; search < LIST + 1u && !found && !drained; search++) {
                uint best = nearestListed(count);
                uint slot = best & 63u;
                drained = best == kNoKey || uintBitsToFloat(best & ~63u) > reach;
                if (!drained) key[slot] = kNoKey;
                ivec4 q = bin_sites[drained ? lane : listed[slot]];
                e = vec3(q.xyz - site);
                id = uint(q.w);
                float square = dot(e, e);
                found = !drained && furthestOver(e, length(e)) >= square * (1.0 - kTestError);
                budget -= min(budget, 4u + count / 8u + top);
                drained = drained || budget == 0u;
            }
            if (found) cutBy(e, id);
            budget -= min(budget, found ? 24u + 2u * top : 1u);
            drained = drained || status != CELL_OK;
        }
        for (uint k = 0u; k < count; k++) key[k] = kNoKey;
        if (ring_done) {
            float clear = ringDistance(site, home, ring);
            finished = clear * clear * 0.9999 > reach;
            ring++;
            row = 0u;
            at = 0u;
            row_end = 0u;
        }
        if (budget == 0u || ring > 24) status = CELL_UNDECIDED;
        finished = finished || status != CELL_OK;
    }
    if (!finished) status = CELL_UNDECIDED;

    // Straight through for all lanes: a cell that is not done writes no planes and no corners.
    uint self = uint(own.w), base = self * RAW_WORDS, live = 0u;
    uint planes = status == CELL_OK ? plane_count : 0u, corners = status == CELL_OK ? top : 0u;
    for (uint k = 0u; k < planes; k++) rim[k] = 0;
    for (uint k = 0u; k < corners; k++) {
        bool used = ((k < 32u ? free_low >> k : free_high >> (k & 31u)) & 1u) == 0u;
        uint t = triple[k];
        if (used) {
            raw[base + 2u + PLANES + live] = t;
            rim[t & 255u] = 1;
            rim[(t >> 8) & 255u] = 1;
            rim[t >> 16] = 1;
            live++;
        }
    }
    for (uint k = 0u; k < planes; k++) raw[base + 2u + k] = rim[k] != 0 ? plane_id[k] : NO_INDEX;
    cell_raw[self] = uvec2(base, 0u);
    raw[base] = status;
    raw[base + 1u] = planes | (live << 16);
}
