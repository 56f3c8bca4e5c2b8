// Box Cutting (the paper, section 3) with a filter: one lane builds one cell in fp32, and stops where an answer is not certain.
//
// Lanes of a subgroup take sites of neighboring bins. Walls of the box are mirrored sites, so that every plane is a bisector
// d.w <= d.d, with d the way to the other site (exact in fp32) and w = 2 (v - site). Each corner keeps w and a bound of its
// error; a test that does not clear the bounds (roundoff 2^-23 an operation, since Vulkan fixes no rounding mode; contraction
// only helps) is put off until the other cuts are made, and where it is still open then the exact kernel goes on with the
// cell; from the box it does so where this one runs out of planes, corners or turns.
//
// An `if` is no saving where lanes run in step: the search for a bisector that cuts is a loop of its own, cutting another.
// Looks at all corners are unrolled: with fixed places an array is as cheap as registers, with computed ones ten times dearer.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_vote : require
#include "lib/kernel.glsl"

#define PLANES RAW_PLANES
#define CORNERS 52
#define LIST 64
#define ALL_CORNERS(k) [[unroll]] for (uint k = 0u; k < CORNERS; k++)
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
    // Loop turns that a lane may take. Mesa's software device stops a subgroup at 65,535 without a word, and lanes that run in
    // step may each take theirs at different times. Unrolled loops take none.
    uint turn_budget;
};
#include "lib/bin_lines.glsl"

const float kRoundoff = 1.0 / 8388608.0;
const float kCornerError = 12.0 * kRoundoff;
const float kTestError = 8.0 * kRoundoff;
const uint kNoKey = 0xffffffffu;
const float kMaxRelativeError = 0.2; // beyond, a corner says nothing

// Phases of a cell's search: rings of bins around its own, 1 to kRings; all lines of bins further out; what was put off.
const uint kRings = 3u, kLines = 4u, kPutOff = 5u, kFinished = 6u;

float plane_x[PLANES], plane_y[PLANES], plane_z[PLANES];
uint plane_id[PLANES];
int rim[PLANES];
float corner_x[CORNERS], corner_y[CORNERS], corner_z[CORNERS]; // w; zero where free
float corner_error[CORNERS];
uint triple[CORNERS];
uint key[LIST];       // squared distance, its last bits replaced by the place in the list
uint listed[LIST];    // place in bin_sites
uint put_off[MOST_OPEN];
uint free_low, free_high, plane_count, status, count, put_off_count, open_count, budget;
float reach;       // squared: no site further away cuts this cell
float worst_error; // of all corners

uint takeLowest(inout uint low, inout uint high) {
    bool lower = low != 0u;
    uint t = lower ? uint(findLSB(low)) : 32u + uint(findLSB(high));
    low = lower ? low & (low - 1u) : 0u;
    high = lower ? high : high & (high - 1u);
    return t;
}

uint takeFree() {
    bool none = (free_low | free_high) == 0u;
    status = none ? CELL_OVERFLOW : status;
    return min(takeLowest(free_low, free_high), CORNERS - 1u);
}

vec3 planeAt(uint p) { return vec3(plane_x[p], plane_y[p], plane_z[p]); }

void setCorner(uint slot, vec3 w, float error) {
    corner_x[slot] = w.x;
    corner_y[slot] = w.y;
    corner_z[slot] = w.z;
    corner_error[slot] = error;
}

float sumOfSizes(vec3 w) { return abs(w.x) + abs(w.y) + abs(w.z); }

// The greatest of several floats and 0 is the greatest of their bits as integers, which is an instruction instead of three.

// How far the cell reaches, and how uncertain its corners are.
void measure() {
    int furthest = 0, worst = 0;
    ALL_CORNERS(k) {
        float x = corner_x[k], y = corner_y[k], z = corner_z[k];
        furthest = max(furthest, floatBitsToInt(x * x + y * y + z * z));
        worst = max(worst, floatBitsToInt(corner_error[k]));
    }
    worst_error = intBitsToFloat(worst);
    float radius = sqrt(intBitsToFloat(furthest)) * (1.0 + kTestError) + worst_error;
    reach = radius * radius * (1.0 + kTestError);
}

void startFromBox(ivec3 site) {
    for (uint k = 0u; k < ROLLED(CORNERS); k++) setCorner(k, vec3(0.0), 0.0);
    for (uint k = 0u; k < ROLLED(PLANES); k++) rim[k] = 0;
    for (uint k = 0u; k < ROLLED(LIST); k++) key[k] = kNoKey;
    vec3 low = vec3(2 * (box_low.xyz - site)), high = vec3(2 * (box_high.xyz - site));
    for (uint k = 0u; k < ROLLED(6); k++) {
        vec3 wall = (k & 1u) != 0u ? high : low;
        plane_x[k] = k / 2u == 0u ? wall.x : 0.0;
        plane_y[k] = k / 2u == 1u ? wall.y : 0.0;
        plane_z[k] = k / 2u == 2u ? wall.z : 0.0;
        plane_id[k] = BOX_BASE + k;
    }
    plane_count = 6u;
    free_low = ~255u;
    free_high = (1u << (CORNERS - 32u)) - 1u;
    for (uint k = 0u; k < ROLLED(8); k++) {
        uint x = k & 1u, y = 2u + ((k >> 1) & 1u), z = 4u + (k >> 2);
        bool odd = ((k ^ (k >> 1) ^ (k >> 2)) & 1u) != 0u;
        vec3 w = vec3((k & 1u) != 0u ? high.x : low.x, (k & 2u) != 0u ? high.y : low.y, (k & 4u) != 0u ? high.z : low.z);
        setCorner(k, w, kTestError * sumOfSizes(w));
        triple[k] = x | ((odd ? y : z) << 8) | ((odd ? z : y) << 16);
    }
    measure();
}

// Whether e may cut at all: one look at all corners, as if all had the error of the worst.
bool mayCut(vec3 e) {
    int even = 0, odd = 0;
    ALL_CORNERS(k) {
        int q = floatBitsToInt(corner_x[k] * e.x + corner_y[k] * e.y + corner_z[k] * e.z);
        if ((k & 1u) != 0u) odd = max(odd, q);
        else even = max(even, q);
    }
    return intBitsToFloat(max(even, odd)) + length(e) * worst_error >= dot(e, e) * (1.0 - kTestError);
}

// The corners that e removes for certain, and whether it may remove others.
struct Look {
    uint gone_low, gone_high;
    bool unsure;
};

Look lookOver(vec3 e) {
    uint gone_low = 0u, gone_high = 0u, doubt_low = 0u, doubt_high = 0u;
    float size = length(e), square = dot(e, e), slack = square * kTestError;
    ALL_CORNERS(k) {
        float beyond = corner_x[k] * e.x + corner_y[k] * e.y + corner_z[k] * e.z - square, error = size * corner_error[k] + slack;
        uint bit = 1u << (k & 31u), gone = beyond > error ? bit : 0u, doubt = beyond >= -error ? bit : 0u;
        if (k < 32u) gone_low |= gone;
        else gone_high |= gone;
        if (k < 32u) doubt_low |= doubt;
        else doubt_high |= doubt;
    }
    return Look(gone_low, gone_high, gone_low != doubt_low || gone_high != doubt_high);
}

uint nearestListed() {
    uint even = kNoKey, odd = kNoKey;
    [[unroll]] for (uint k = 0u; k < LIST; k += 2u) {
        even = min(even, key[k]);
        odd = min(odd, key[k + 1u]);
    }
    return min(even, odd);
}

void list(uint place, float square) {
    key[count] = (floatBitsToUint(square) & ~63u) | count;
    listed[count] = place;
    count++;
}

int weigh(uint p) { return int(p) + 256 * int(p * p); }

void addToRim(uint t) {
    uint a = triple[t] & 255u, b = (triple[t] >> 8) & 255u, c = triple[t] >> 16;
    int wa = weigh(a), wb = weigh(b), wc = weigh(c);
    rim[a] += wb - wc;
    rim[b] += wc - wa;
    rim[c] += wa - wb;
}

// What is left on a rim plane is next - previous + 256 (next^2 - previous^2): both can be told from it, or one from the other.
uint previousOnRim(int sum) {
    int difference = (sum << 24) >> 24;
    int squares = (sum - difference) >> 8;
    int total = int(roundEven(float(squares) / float(difference)));
    return uint((total - difference) >> 1) & 63u;
}
uint nextOnRim(int sum, uint previous) { return (uint(sum) + previous) & 63u; }

void removeCorners(uint low, uint high) {
    free_low |= low;
    free_high |= high;
    for (uint k = 0u; k < CORNERS && (low | high) != 0u; k++) addToRim(takeLowest(low, high));
}

// A plane of the rim that removed corners leave.
uint anyOnRim(uint low, uint high) {
    uint found = 0u;
    bool open = (low | high) != 0u;
    for (uint k = 0u; k < CORNERS && (low | high) != 0u && open; k++) {
        uint t = triple[takeLowest(low, high)], a = t & 255u, b = (t >> 8) & 255u, c = t >> 16;
        bool ra = rim[a] != 0, rb = rim[b] != 0, rc = rim[c] != 0;
        found = ra ? a : (rb ? b : c);
        open = !(ra || rb || rc);
    }
    return found;
}

// Walks along the rim, and puts a corner on the new plane between each plane of it and the next.
void closeRim(bool cuts, uint start, vec3 e) {
    vec3 here = planeAt(start), past = cross(e, here);
    float e_size = length(e), here_size = length(here);
    uint at = start, previous = previousOnRim(rim[start]);
    bool open = cuts;
    for (uint k = 0u; k < PLANES && open; k++) {
        int sum = rim[at];
        uint next = nextOnRim(sum, previous);
        rim[at] = 0;
        vec3 there = planeAt(next), ahead = cross(e, there), across = cross(here, there);
        float there_size = length(there), inverse = 1.0 / dot(e, across);
        vec3 w = (dot(there, there) * past - dot(here, here) * ahead + dot(e, e) * across) * inverse;
        float size = length(w);
        float error = kCornerError * here_size * there_size * e_size * abs(inverse) * (here_size + there_size + e_size + size) +
                      kTestError * sumOfSizes(w);
        status = sum != 0 && error < kMaxRelativeError * size ? status : CELL_UNDECIDED;
        uint slot = takeFree();
        setCorner(slot, w, error);
        triple[slot] = at | (next << 8) | (plane_count << 16);
        previous = at;
        at = next;
        here = there;
        here_size = there_size;
        past = ahead;
        open = at != start && status == CELL_OK;
        budget -= min(budget, 3u); // with those two that will remove this corner
    }
}

// Removes corners, and closes the rim that they leave by corners on the new plane.
void cutBy(uint gone_low, uint gone_high, vec3 e, uint id) {
    bool cuts = (gone_low | gone_high) != 0u;
    if (cuts && plane_count + 1u >= PLANES) status = CELL_OVERFLOW;
    cuts = cuts && status == CELL_OK;
    uint low = cuts ? gone_low : 0u, high = cuts ? gone_high : 0u;
    removeCorners(low, high);
    uint start = anyOnRim(low, high);
    if (cuts) {
        plane_x[plane_count] = e.x;
        plane_y[plane_count] = e.y;
        plane_z[plane_count] = e.z;
        plane_id[plane_count] = id;
    }
    closeRim(cuts, start, e);
    plane_count += cuts ? 1u : 0u;
    // Few are left: only planes that vanish leave fewer corners than before.
    low &= free_low;
    high &= free_high;
    for (uint k = 0u; k < CORNERS && (low | high) != 0u; k++) setCorner(takeLowest(low, high), vec3(0.0), 0.0);
    measure();
}

// Where the search stands: in a ring, the line (y, z) and its half; among lines, the next one. Then the sites of a row.
int row_y, row_z, row_half;
uint phase, row, at, row_end, line_y, line_z;

// Rows of the rings around the home bin: whole lines along x where they bound the cube of the ring or nothing was seen before
// it, elsewhere its two ends. Steps to the next that the search radius reaches.
bool findRow(int ring, ivec3 site, ivec3 home, out ivec2 part) {
    bool found = at < row_end || phase > kRings, fresh = !found;
    part = ivec2(1, 0);
    for (uint guard = 0u; guard < 4096u && !found && row_z <= ring; guard++) {
        bool whole = ring == 1 || abs(row_y) == ring || abs(row_z) == ring, right = row_half == 1;
        float dy = gap(spanOf(home.y + row_y, site.y, box_low.y)), dz = gap(spanOf(home.z + row_z, site.z, box_low.z));
        float left = reach - dy * dy - dz * dz, half_ = sqrt(max(left, 0.0));
        ivec2 reached = binsOfPart(vec2(-half_, half_), site.x);
        part.x = max(reached.x, !whole && right ? home.x + ring : home.x - ring);
        part.y = min(reached.y, !whole && !right ? home.x - ring : home.x + ring);
        bool inside = all(greaterThanEqual(ivec2(home.y + row_y, home.z + row_z), ivec2(0))) &&
                      all(lessThan(ivec2(home.y + row_y, home.z + row_z), bins.yz));
        found = inside && left >= 0.0 && part.x <= part.y;
        row = binIndex(ivec3(0, home.y + row_y, home.z + row_z));
        row_half = whole || right ? 0 : 1;
        row_y += row_half == 0 ? 1 : 0;
        bool slab_done = row_y > ring;
        row_y = slab_done ? -ring : row_y;
        row_z += slab_done ? 1 : 0;
        budget -= min(budget, 1u);
    }
    return found && fresh;
}

void fillFromRing(uint lane, ivec3 site, ivec3 home) {
    int ring = int(min(phase, kRings));
    bool more = phase <= kRings;
    for (uint guard = 0u; guard < 4096u && more; guard++) {
        ivec2 part;
        bool fresh = findRow(ring, site, home, part);
        uint begin = bin_start[fresh ? row + uint(part.x) : 0u], end = bin_start[fresh ? row + uint(part.y) + 1u : 0u];
        at = fresh ? begin : at;
        row_end = fresh ? end : row_end;
        for (uint inner = 0u; inner < 4096u && at < row_end && count < LIST && budget > 0u && more; inner++) {
            vec3 d = vec3(bin_sites[at].xyz - site);
            float square = dot(d, d);
            if (at != lane && square <= reach) list(at, square);
            at++;
            budget--;
        }
        more = more && count < LIST && budget > 0u && row_z <= ring;
    }
}

// The k-th of n bins counted from bin h outwards.
int outward(uint k, int h, int n) {
    int near = min(h, n - 1 - h), i = int(k);
    int around = (i & 1) != 0 ? h + (i + 1) / 2 : h - i / 2, beyond = h < n - 1 - h ? i : n - 1 - i;
    return i <= 2 * near ? around : beyond;
}

// Steps to the next line of bins that the search radius reaches.
bool findLine(ivec3 site, ivec3 home) {
    bool found = at < row_end || phase != kLines;
    bool fresh = !found;
    for (uint guard = 0u; guard < 4096u && !found && line_z < uint(bins.z) && budget > 0u; guard++) {
        float dz = gap(spanOf(outward(line_z, home.z, bins.z), site.z, box_low.z));
        float dy = gap(spanOf(outward(line_y, home.y, bins.y), site.y, box_low.y));
        bool slab = dz * dz <= reach;
        found = slab && dy * dy + dz * dz <= reach;
        row = line_y | (line_z << 16);
        line_y++;
        bool ended = !slab || line_y == uint(bins.y);
        line_y = ended ? 0u : line_y;
        line_z += ended ? 1u : 0u;
        budget -= min(budget, 1u);
    }
    return found && fresh;
}

void openLine(ivec3 site, ivec3 home) {
    int y = outward(row & 0xffffu, home.y, bins.y), z = outward(row >> 16, home.z, bins.z);
    vec2 span_y = spanOf(y, site.y, box_low.y), span_z = spanOf(z, site.z, box_low.z), part = vec2(1e30, -1e30);
    ALL_CORNERS(k) widenByBall(part, vec3(corner_x[k], corner_y[k], corner_z[k]), corner_error[k], span_y, span_z);
    ivec2 reached = binsOfPart(part, site.x);
    bool any_ = reached.x <= reached.y;
    uint first = uint((z * bins.y + y) * bins.x);
    at = any_ ? bin_start[first + uint(reached.x)] : 0u;
    row_end = any_ ? bin_start[first + uint(reached.y) + 1u] : 0u;
}

void fillFromLines(uint lane, ivec3 site, ivec3 home) {
    ivec3 low = box_low.xyz + (home - int(kRings)) * bins.w, high = box_low.xyz + (home + int(kRings) + 1) * bins.w;
    bool more = phase == kLines;
    for (uint guard = 0u; guard < 4096u && more; guard++) {
        if (findLine(site, home)) openLine(site, home);
        for (uint inner = 0u; inner < 4096u && at < row_end && count < LIST && budget > 0u && more; inner++) {
            ivec4 q = bin_sites[at];
            vec3 d = vec3(q.xyz - site);
            bool seen = all(greaterThanEqual(q.xyz, low)) && all(lessThan(q.xyz, high));
            float square = dot(d, d);
            if (!seen && square <= reach) list(at, square);
            at++;
            budget -= min(budget, 1u);
        }
        more = more && count < LIST && budget > 0u && line_z < uint(bins.z);
    }
}

void fillFromPutOff(ivec3 site) {
    for (uint k = 0u; k < MOST_OPEN && k < put_off_count && phase == kPutOff; k++) {
        vec3 d = vec3(bin_sites[put_off[k]].xyz - site);
        list(put_off[k], dot(d, d));
    }
}

// What is uncertain is put off, since a later cut may remove the corner in question; what then still is, is left open.
void putOff(uint place) {
    bool last = phase == kPutOff;
    uint slot = last ? open_count : put_off_count;
    if (slot >= MOST_OPEN) status = CELL_UNDECIDED;
    put_off[min(slot, MOST_OPEN - 1u)] = place;
    put_off_count += last ? 0u : 1u;
    open_count += last ? 1u : 0u;
}

// Cuts by what is listed, near to far.
void cutByListed(uint lane, ivec3 site) {
    bool drained = phase == kFinished;
    for (uint step = 0u; step < 128u && !drained; step++) {
        vec3 e = vec3(0.0);
        uint place = lane;
        bool found = false, ready = drained;
        for (uint search = 0u; search < LIST + 1u && !ready; search++) {
            uint best = nearestListed(), slot = best & 63u;
            bool ended = best == kNoKey || uintBitsToFloat(best & ~63u) > reach || budget == 0u;
            uint candidate = ended ? lane : listed[slot];
            vec3 d = vec3(bin_sites[candidate].xyz - site);
            bool may = !ended && mayCut(d), first = may && !found;
            if (!ended && (first || !may)) key[slot] = kNoKey;
            place = first ? candidate : place;
            e = first ? d : e;
            drained = ended && !found;
            found = found || first;
            // Lanes go on while any has found nothing: what does not cut the cell as it is will not cut what is left of it.
            ready = subgroupAll(found || ended);
            budget -= min(budget, 1u);
        }
        Look look = lookOver(e);
        if (found && look.unsure) putOff(place);
        bool cuts = found && !look.unsure;
        cutBy(cuts ? look.gone_low : 0u, cuts ? look.gone_high : 0u, e, uint(bin_sites[place].w));
        budget -= min(budget, 8u);
        drained = drained || status != CELL_OK;
    }
    for (uint k = 0u; k < count; k++) key[k] = kNoKey;
    budget -= min(budget, count + 1u);
    count = 0u;
}

void nextPhase(ivec3 site, ivec3 home) {
    bool ring_done = phase <= kRings && row_z > int(phase) && at >= row_end;
    float clear = ringDistance(site, home, int(min(phase, kRings)));
    bool enough = ring_done && clear * clear * 0.9999 > reach;
    bool all_seen = phase == kLines && line_z >= uint(bins.z) && at >= row_end;
    if (phase == kPutOff) phase = kFinished;
    else if (enough || all_seen) phase = put_off_count > 0u ? kPutOff : kFinished;
    else if (ring_done) phase++;
    if (ring_done) {
        row_y = -int(phase);
        row_z = -int(phase);
        at = 0u;
        row_end = 0u;
    }
    if (budget == 0u && phase != kFinished) status = CELL_UNDECIDED;
    if (status != CELL_OK) phase = kFinished;
}

void writeCell(uint self) {
    // Straight through for all lanes: a cell that is not done writes no planes and no corners.
    uint base = self * RAW_WORDS, live = 0u;
    bool ok = status == CELL_OK;
    uint planes = ok ? plane_count : 0u;
    uint low = ok ? ~free_low : 0u, high = ok ? ~free_high & ((1u << (CORNERS - 32u)) - 1u) : 0u;
    for (uint k = 0u; k < CORNERS && (low | high) != 0u; k++) {
        uint t = triple[takeLowest(low, high)];
        raw[base + 2u + PLANES + live] = t;
        rim[t & 255u] = 1;
        rim[(t >> 8) & 255u] = 1;
        rim[t >> 16] = 1;
        live++;
    }
    for (uint k = 0u; k < planes; k++) raw[base + 2u + k] = rim[k] != 0 ? plane_id[k] : NO_INDEX;
    uint open = ok ? open_count : 0u;
    for (uint k = 0u; k < MOST_OPEN && k < open; k++) raw[base + RAW_OPEN + k] = uint(bin_sites[put_off[k]].w);
    cell_raw[self] = uvec2(base, 0u);
    raw[base] = open != 0u ? CELL_OPEN | (open << 8) : status;
    raw[base + 1u] = planes | (live << 16);
}

void main() {
    uint lane = flatIndex();
    if (lane >= min(slots, counts[COUNT_SITES])) return;
    ivec4 own = bin_sites[lane];
    ivec3 site = own.xyz, home = binOf(own.xyz);
    status = CELL_OK;
    phase = 1u;
    row_y = -1;
    row_z = -1;
    row_half = 0;
    row = 0u;
    at = 0u;
    row_end = 0u;
    line_y = 0u;
    line_z = 0u;
    count = 0u;
    put_off_count = 0u;
    open_count = 0u;
    budget = turn_budget;
    startFromBox(site);
    for (uint turn = 0u; turn < 1024u && phase != kFinished; turn++) {
        fillFromRing(lane, site, home);
        fillFromLines(lane, site, home);
        fillFromPutOff(site);
        cutByListed(lane, site);
        nextPhase(site, home);
    }
    if (phase != kFinished) status = CELL_UNDECIDED;
    writeCell(uint(own.w));
}
