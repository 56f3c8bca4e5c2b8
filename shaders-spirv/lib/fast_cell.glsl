// A Voronoi cell while one lane cuts it in fp32: planes, corners as triples of planes, and a list of candidates.
//
// Walls of the box are mirrored sites, so that every plane is a bisector d.w <= d.d, with d the way to the other site (exact
// in fp32) and w = 2 (v - site). Each corner keeps w and a bound of its error; a test that does not clear the bounds is put off
// until the other cuts are made, and where it is still open then the exact kernel goes on with the cell.
//
// An `if` is no saving where lanes run in step: the search for a bisector that cuts is a loop of its own, cutting another.
// Looks at all corners are unrolled: with fixed places an array is as cheap as registers, with computed ones ten times dearer.
//
// Wants bin_sites, raw, cell_raw and the push constants box_low and box_high declared.
#include "lib/filter_bounds.glsl"
#include "lib/rounded_cut.glsl"
#include "lib/tile.glsl"

#define PLANES RAW_PLANES
#define CORNERS 52
#define LIST 64
#define ALL_CORNERS(k) [[unroll]] for (uint k = 0u; k < CORNERS; k++)

const uint kNoKey = 0xffffffffu;

const uint kSearching = 1u, kPutOff = 2u, kFinished = 3u;

uint phase;
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
    vec3 low = vec3(2 * (box_low.xyz - inTile(site))), high = vec3(2 * (box_high.xyz - inTile(site)));
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

void beginCell(ivec3 site) {
    phase = kSearching;
    status = CELL_OK;
    count = 0u;
    put_off_count = 0u;
    open_count = 0u;
    budget = turn_budget;
    startFromBox(site);
}

// At least the greatest e.w of all corners w, or 0: one look at all of them, as if all had the error of the worst.
float furthestAlong(vec3 e) {
    int even = 0, odd = 0;
    ALL_CORNERS(k) {
        int q = floatBitsToInt(corner_x[k] * e.x + corner_y[k] * e.y + corner_z[k] * e.z);
        if ((k & 1u) != 0u) odd = max(odd, q);
        else even = max(even, q);
    }
    return intBitsToFloat(max(even, odd)) + length(e) * worst_error;
}

// Whether e may cut at all.
bool mayCut(vec3 e) { return furthestAlong(e) >= dot(e, e) * (1.0 - kTestError); }

// The corners that e removes for certain, and whether it may remove others.
struct Look {
    uint gone_low, gone_high, doubt_low, doubt_high; // who is in doubt may be gone or not
    bool unsure;
};

Look lookOver(vec3 e) {
    uint gone_low = 0u, gone_high = 0u, doubt_low = 0u, doubt_high = 0u;
    float size = length(e), square = dot(e, e), slack = square * kTestError;
    ALL_CORNERS(k) {
        float beyond = corner_x[k] * e.x + corner_y[k] * e.y + corner_z[k] * e.z - square, error = kFast ? 0.0 : size * corner_error[k] + slack;
        uint bit = 1u << (k & 31u), gone = beyond > error ? bit : 0u, doubt = kFast ? gone : (beyond >= -error ? bit : 0u);
        if (k < 32u) gone_low |= gone;
        else gone_high |= gone;
        if (k < 32u) doubt_low |= doubt;
        else doubt_high |= doubt;
    }
    bool unsure = gone_low != doubt_low || gone_high != doubt_high;
    return Look(gone_low, gone_high, doubt_low & ~gone_low, doubt_high & ~gone_high, unsure);
}

#ifdef DOUBLES
// Decides in fp64 what is in doubt in fp32.
void settle(inout Look look, vec3 e) {
    RoundedPlane cut = roundedBisector(real3(e));
    for (uint k = 0u; k < CORNERS && (look.doubt_low | look.doubt_high) != 0u; k++) {
        uint t = takeLowest(look.doubt_low, look.doubt_high), planes = triple[t], bit = 1u << (t & 31u);
        RoundedPlane a = roundedBisector(real3(planeAt(planes & 255u))), b = roundedBisector(real3(planeAt((planes >> 8) & 255u)));
        bool gone = roundedCuts(a, b, roundedBisector(real3(planeAt(planes >> 16))), cut);
        look.gone_low |= gone && t < 32u ? bit : 0u;
        look.gone_high |= gone && t >= 32u ? bit : 0u;
        budget -= min(budget, 1u);
    }
    look.unsure = false;
}
#endif

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
        float error = kFast ? 0.0 : kCornerError * here_size * there_size * e_size * abs(inverse) * (here_size + there_size + e_size + size) +
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

void listPutOff(ivec3 site) {
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
            // Lanes go on while any has found nothing: what does not cut the cell as it is will not cut what is left of it. So
            // a lane that stops by itself finds the same candidates, and only later strikes off those that do not cut.
#ifdef NO_VOTE
            ready = found || ended;
#else
            ready = subgroupAll(found || ended);
#endif
            budget -= min(budget, 1u);
        }
        Look look = lookOver(e);
#ifdef DOUBLES
        if (found) settle(look, e);
#endif
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
