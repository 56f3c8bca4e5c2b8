// Candidates of a cell from the bins of the search grid: rings of bins around the home bin, then all lines of bins further out.
// Wants bin_start, the push constant bins, and lib/fast_cell.glsl.
#include "lib/bin_lines.glsl"

#define MOST_SEARCH_TURNS 1024u

const int kRings = 3;
const int kLines = kRings + 1; // in place of a ring: all lines

// Where the search stands: in a ring at a line (y, z) and its half, among the lines at the next one; then the sites of a row.
ivec3 home, from; // the home bin, and the site within its tile
uint tile_bins;   // the first bin of the tile
int ring, row_y, row_z, row_half;
uint row, at, row_end, line_y, line_z;

void openRing(int r) {
    ring = r;
    row_y = -r;
    row_z = -r;
    row_half = 0;
    at = 0u;
    row_end = 0u;
}

void beginSearch(uint lane, ivec3 site) {
    home = binOf(site);
    from = inTile(site);
    tile_bins = binIndex(ivec3(0), site);
    openRing(1);
    row = 0u;
    line_y = 0u;
    line_z = 0u;
}

// Rows of the rings around the home bin: whole lines along x where they bound the cube of the ring or nothing was seen before
// it, elsewhere its two ends. Steps to the next that the search radius reaches.
bool findRow(out ivec2 part) {
    bool found = at < row_end, fresh = !found;
    part = ivec2(1, 0);
    for (uint guard = 0u; guard < 4096u && !found && row_z <= ring; guard++) {
        bool whole = ring == 1 || abs(row_y) == ring || abs(row_z) == ring, right = row_half == 1;
        float dy = gap(spanOf(home.y + row_y, from.y, box_low.y)), dz = gap(spanOf(home.z + row_z, from.z, box_low.z));
        float left = reach - dy * dy - dz * dz, half_ = sqrt(max(left, 0.0));
        ivec2 reached = binsOfPart(vec2(-half_, half_), from.x);
        part.x = max(reached.x, !whole && right ? home.x + ring : home.x - ring);
        part.y = min(reached.y, !whole && !right ? home.x - ring : home.x + ring);
        bool inside = all(greaterThanEqual(ivec2(home.y + row_y, home.z + row_z), ivec2(0))) &&
                      all(lessThan(ivec2(home.y + row_y, home.z + row_z), bins.yz));
        found = inside && left >= 0.0 && part.x <= part.y;
        row = tile_bins + uint(((home.z + row_z) * bins.y + home.y + row_y) * bins.x);
        row_half = whole || right ? 0 : 1;
        row_y += row_half == 0 ? 1 : 0;
        bool slab_done = row_y > ring;
        row_y = slab_done ? -ring : row_y;
        row_z += slab_done ? 1 : 0;
        budget -= min(budget, 1u);
    }
    return found && fresh;
}

void fillFromRing(uint lane, ivec3 site) {
    bool more = phase == kSearching && ring <= kRings;
    for (uint guard = 0u; guard < 4096u && more; guard++) {
        ivec2 part;
        bool fresh = findRow(part);
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
bool findLine() {
    bool found = at < row_end, fresh = !found;
    for (uint guard = 0u; guard < 4096u && !found && line_z < uint(bins.z) && budget > 0u; guard++) {
        float dz = gap(spanOf(outward(line_z, home.z, bins.z), from.z, box_low.z));
        float dy = gap(spanOf(outward(line_y, home.y, bins.y), from.y, box_low.y));
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

void openLine() {
    int y = outward(row & 0xffffu, home.y, bins.y), z = outward(row >> 16, home.z, bins.z);
    vec2 span_y = spanOf(y, from.y, box_low.y), span_z = spanOf(z, from.z, box_low.z), part = vec2(1e30, -1e30);
    ALL_CORNERS(k) widenByBall(part, vec3(corner_x[k], corner_y[k], corner_z[k]), corner_error[k], span_y, span_z);
    ivec2 reached = binsOfPart(part, from.x);
    bool any_ = reached.x <= reached.y;
    uint first = tile_bins + uint((z * bins.y + y) * bins.x);
    at = any_ ? bin_start[first + uint(reached.x)] : 0u;
    row_end = any_ ? bin_start[first + uint(reached.y) + 1u] : 0u;
}

void fillFromLines(ivec3 site) {
    ivec3 corner = tileOf(site) + box_low.xyz, low = corner + (home - kRings) * bins.w, high = corner + (home + kRings + 1) * bins.w;
    bool more = phase == kSearching && ring == kLines;
    for (uint guard = 0u; guard < 4096u && more; guard++) {
        if (findLine()) openLine();
        for (uint inner = 0u; inner < 4096u && at < row_end && count < LIST && budget > 0u && more; inner++) {
            ivec3 q = bin_sites[at].xyz;
            vec3 d = vec3(q - site);
            bool seen = all(greaterThanEqual(q, low)) && all(lessThan(q, high));
            float square = dot(d, d);
            if (!seen && square <= reach) list(at, square);
            at++;
            budget -= min(budget, 1u);
        }
        more = more && count < LIST && budget > 0u && line_z < uint(bins.z);
    }
}

bool searchGoesOn() { return phase != kFinished; }

void fillList(uint lane, ivec3 site) {
    fillFromRing(lane, site);
    fillFromLines(site);
}

// After what was listed is cut: true once nothing nearer than the cell reaches is left unseen.
bool searchEnds(ivec3 site) {
    bool ring_done = ring <= kRings && row_z > ring && at >= row_end;
    float clear = ringDistance(site, home, min(ring, kRings));
    bool enough = ring_done && clear * clear * 0.9999 > reach;
    bool all_seen = ring == kLines && line_z >= uint(bins.z) && at >= row_end;
    if (ring_done) openRing(ring + 1);
    return enough || all_seen;
}
