// Candidates of a cell that a workgroup cuts, from the bins of the search grid: two cubes of bins around the home bin, then all
// that is left. What may cut is listed in shared memory and taken from there near to far.
//
// Bisectors that remove some corner for certain come first. Those that touch only corners in question wait until the end,
// when most such corners are gone.
//
// Wants LANES, SIEVE_CORNERS and bin_start, bin_sites, sites and the push constants bins and box_low declared; of the cell
// corner_place[k]: w in fp32, and how far it may be off (lib/filter_bounds.glsl); and sync().
#include "lib/bin_lines.glsl"
#include "lib/sum_before.glsl"

#define LIST_SIZE (LANES > 512 ? 2 * LANES : 1024)
#define WAITING 0x80000000u /* in a key: touches only corners in question */

int ringsOf(uint cube) { return cube == 0u ? 1 : 3; }
// Of the 65,535 loop turns that Mesa's software device allows; a cell that needs more goes to the next kernel.
const uint kTurnBudget = 56000u;

shared uint list_key[LIST_SIZE];
shared uint list_site[LIST_SIZE];
shared uint line_first[LANES];
shared uint line_end[LANES];
shared uint list_count, best_key, best_site, best_slot, reach_bits, removed_count, open_count;

// The same for all lanes.
uint self, corner_top, plane_count, status, budget;
ivec3 site, home;

// Cuts by what is listed, near to far; by what waits only where asked to.
void cutByListed(uint lane, bool waiting_too);

void startSearch(uint lane) {
    status = CELL_OK;
    budget = kTurnBudget;
    home = binOf(site);
    if (lane == 0u) {
        reach_bits = floatBitsToUint(1e30);
        list_count = 0u;
    }
}

void spend(uint turns) { budget -= min(budget, turns); }
uint cornerTurns() { return corner_top / LANES + 1u; }
bool onCorner(uint t) { return t < corner_top; }

// Squared: no site further away cuts this cell.
void measureReach(uint lane) {
    if (lane == 0u) reach_bits = 0u;
    sync();
    uint reach = 0u, turns = cornerTurns();
    for (uint k = 0u; k < turns; k++) {
        vec4 c = corner_place[min(k * LANES + lane, corner_top - 1u)];
        float radius = length(c.xyz) + c.w;
        reach = max(reach, floatBitsToUint(radius * radius * 1.0001));
    }
    atomicMax(reach_bits, reach);
    sync();
    spend(turns);
}

// The key under which a candidate is listed, a candidate a lane. The cell only shrinks, so NO_INDEX is for good.
uint keyOf(vec3 d) {
    uint looked = corner_top <= SIEVE_CORNERS ? corner_top : 0u;
    float square = dot(d, d), size = length(d), possible = looked == 0u ? square : 0.0, certain = possible;
    for (uint k = 0u; k < looked; k++) {
        vec4 c = corner_place[k];
        float q = dot(d, c.xyz), slack = size * c.w;
        possible = max(possible, q + slack);
        certain = max(certain, q - slack);
    }
    bool waits = looked != 0u && certain <= square * (1.0 + kPlaceError);
    uint key = floatBitsToUint(square) | (waits ? WAITING : 0u);
    return possible >= square * (1.0 - kPlaceError) ? key : NO_INDEX;
}

// After every cut where it is cheap, now and then where it is not.
void sieveList(uint lane) {
    uint total = list_count, turns = (total / LANES + 1u) * (corner_top + 1u);
    if (corner_top > SIEVE_CORNERS || (turns > 256u && plane_count % 8u != 0u)) return;
    for (uint k = lane; k < total; k += LANES) {
        if (list_key[k] != NO_INDEX) list_key[k] = keyOf(vec3(sites[list_site[k]].xyz - site));
    }
    spend(turns);
    sync();
}

// Finds in the next LANES lines of a cube, a line a lane, the bins whose sites may cut a corner; returns how many sites.
uint openLines(uint lane, uint first_line, int cube, bool all_bins) {
    int width = all_bins ? bins.y : 2 * cube + 1, line = int(first_line + lane);
    int y = all_bins ? line % width : home.y + line % width - cube, z = all_bins ? line / width : home.z + line / width - cube;
    bool inside = y >= 0 && y < bins.y && z >= 0 && z < bins.z && line < (all_bins ? bins.y * bins.z : width * width);
    ivec3 from = inTile(site);
    vec2 span_y = spanOf(y, from.y, box_low.y), span_z = spanOf(z, from.z, box_low.z), part = vec2(1e30, -1e30);
    uint looked = corner_top <= SIEVE_CORNERS ? corner_top : 0u;
    for (uint k = 0u; k < looked; k++) widenByBall(part, corner_place[k].xyz, corner_place[k].w, span_y, span_z);
    spend(looked + 1u);
    ivec2 reached = looked == 0u ? ivec2(0, bins.x - 1) : binsOfPart(part, from.x);
    int x0 = all_bins ? reached.x : max(reached.x, home.x - cube), x1 = all_bins ? reached.y : min(reached.y, home.x + cube);
    bool any_ = inside && x0 <= x1;
    uint row = any_ ? binIndex(ivec3(0, y, z), site) : 0u;
    uint begin = any_ ? bin_start[row + uint(x0)] : 0u, end = any_ ? bin_start[row + uint(x1) + 1u] : 0u;
    line_first[lane] = begin;
    sumBefore(lane, end - begin);
    line_end[lane] = lane_sum[lane];
    sync();
    return line_end[LANES - 1];
}

// Lists the sites from the opened lines, from the k-th on, that may still cut; `seen` is the cube that was searched before.
void listSites(uint lane, uint k, uint total, int seen) {
    uint low = 0u, high = LANES - 1u;
    for (uint step = 0u; step < 11u && low < high; step++) {
        uint middle = (low + high) / 2u;
        if (line_end[middle] > k) high = middle;
        else low = middle + 1u;
    }
    bool is_site = k < total;
    uint before = low > 0u ? line_end[low - 1u] : 0u;
    ivec4 q = bin_sites[is_site ? line_first[low] + k - before : 0u];
    vec3 d = vec3(q.xyz - site);
    ivec3 away = abs(binOf(q.xyz) - home);
    bool fresh = is_site && uint(q.w) != self && max(away.x, max(away.y, away.z)) > seen;
    uint key = keyOf(d);
    if (fresh && key != NO_INDEX && dot(d, d) <= uintBitsToFloat(reach_bits)) {
        uint s = atomicAdd(list_count, 1u);
        list_key[s] = key;
        list_site[s] = uint(q.w);
    }
    spend(12u + min(corner_top, SIEVE_CORNERS));
    sync();
}

// Strikes the nearest candidate off the list, by (distance, id); false where there is none but those that wait.
bool takeNearest(uint lane, bool waiting_too) {
    if (lane == 0u) {
        best_key = NO_INDEX;
        best_site = NO_INDEX;
        removed_count = 0u;
        open_count = 0u;
    }
    sync();
    uint key = NO_INDEX, id = NO_INDEX, slot = 0u, total = list_count;
    for (uint s = lane; s < total; s += LANES) {
        uint k = list_key[s];
        k = (k & WAITING) != 0u && !waiting_too ? NO_INDEX : k;
        bool better = k < key || (k == key && k != NO_INDEX && list_site[s] < id);
        key = better ? k : key;
        id = better ? list_site[s] : id;
        slot = better ? s : slot;
    }
    atomicMin(best_key, key);
    sync();
    if (key == best_key) atomicMin(best_site, id);
    sync();
    if (key != NO_INDEX && key == best_key && id == best_site) {
        best_slot = slot;
        list_key[slot] = NO_INDEX;
    }
    sync();
    spend(total / LANES + 2u);
    return best_key != NO_INDEX;
}

// Closes the gaps that struck candidates leave. A turn never writes beyond what it has read.
void packList(uint lane) {
    uint total = list_count;
    sync();
    if (lane == 0u) list_count = 0u;
    sync();
    for (uint first = 0u; first < total; first += LANES) {
        uint s = min(first + lane, total - 1u), key = list_key[s], id = list_site[s];
        sync();
        if (first + lane < total && key != NO_INDEX) {
            uint to = atomicAdd(list_count, 1u);
            list_key[to] = key;
            list_site[to] = id;
        }
        sync();
    }
    spend(total / LANES + 1u);
}

void searchCell(uint lane, bool searched_before) {
    uint cube = 0u, next_line = 0u, done = 0u, total = 0u;
    bool last = searched_before, finished = false;
    for (uint turn = 0u; turn < 4096u && !finished; turn++) {
        bool all_bins = cube == 2u;
        int width = 2 * ringsOf(cube) + 1;
        uint lines = all_bins ? uint(bins.y * bins.z) : uint(width * width);
        if (done >= total && next_line < lines && !last) {
            total = openLines(lane, next_line, ringsOf(cube), all_bins);
            next_line += LANES;
            done = 0u;
        }
        for (uint guard = 0u; guard < 4096u && done < total && list_count + LANES <= LIST_SIZE && budget > 0u; guard++) {
            sync();
            listSites(lane, done + lane, total, cube == 0u ? -1 : ringsOf(cube - 1u));
            done += LANES;
        }
        bool full = list_count + LANES > LIST_SIZE;
        sync();
        cutByListed(lane, last || full);
        packList(lane);
        bool searched = done >= total && next_line >= lines;
        if (last) finished = true;
        if (searched && !last) {
            float clear = ringDistance(site, home, ringsOf(cube));
            last = all_bins || clear * clear * 0.9999 > uintBitsToFloat(reach_bits);
            finished = last && list_count == 0u;
            cube = min(cube + 1u, 2u);
            next_line = 0u;
            done = 0u;
            total = 0u;
        }
        if (budget == 0u) status = CELL_OVERFLOW;
        finished = finished || status != CELL_OK;
        sync();
    }
    if (!finished) status = CELL_OVERFLOW;
}
