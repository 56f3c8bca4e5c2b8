// The search bins, and lines of them along x; every tile has its own. Wants the push constants bins and box_low.
#include "lib/tile.glsl"

ivec3 binOf(ivec3 place) { return min((inTile(place) - box_low.xyz) / bins.w, bins.xyz - 1); }
// `place`: any of the tile.
uint binIndex(ivec3 bin, ivec3 place) {
    return uint((bin.z * bins.y + bin.y) * bins.x + bin.x) + tileNumber(place) * uint(bins.x * bins.y * bins.z);
}
uint binIndexOf(ivec3 place) { return binIndex(binOf(place), place); }

// Way from a site to a bin along one axis: to its nearest and its furthest place.
vec2 spanOf(int bin, int from, int low) { return vec2(float(low + bin * bins.w - from), float(low + (bin + 1) * bins.w - from)); }
float gap(vec2 span) { return max(0.0, max(span.x, -span.y)); }

// How near a site can be that lies in no bin of the cube of rings around the home bin; where the cube covers all bins,
// further than any.
float ringDistance(ivec3 site, ivec3 home, int ring) {
    ivec3 at = inTile(site) - box_low.xyz, below = at - (home - ring) * bins.w, above = (home + ring + 1) * bins.w - at;
    float least = 1e30;
    for (int k = 0; k < 3; k++) {
        least = home[k] - ring > 0 ? min(least, float(below[k])) : least;
        least = home[k] + ring + 1 < bins[k] ? min(least, float(above[k])) : least;
    }
    return least;
}

// A site d cuts corner w where d.w > d.d: inside the ball with w for a diameter. Widens `part`, an interval along x, by what
// of a line of bins may meet this ball: the best y and z first, what is left is a quadratic in x.
void widenByBall(inout vec2 part, vec3 w, float error, vec2 span_y, vec2 span_z) {
    float y = clamp(0.5 * w.y, span_y.x, span_y.y), z = clamp(0.5 * w.z, span_z.x, span_z.y);
    float size = abs(w.x) + abs(w.y) + abs(w.z);
    float slack = size * (1.25 * error + size * (16.0 / 8388608.0));
    float left = y * (w.y - y) + z * (w.z - z) + 0.25 * w.x * w.x + slack;
    float half_ = sqrt(max(left, 0.0));
    part.x = left >= 0.0 ? min(part.x, 0.5 * w.x - half_) : part.x;
    part.y = left >= 0.0 ? max(part.y, 0.5 * w.x + half_) : part.y;
}

// First and last bin of a line that an interval along x touches; last < first where none is.
ivec2 binsOfPart(vec2 part, int from) {
    float edge = float(bins.w), limit = float(bins.x), at = float(from - box_low.x);
    int first = int(clamp((at + part.x - 4.0) / edge - 0.001, 0.0, limit));
    int last = int(clamp((at + part.y + 4.0) / edge + 0.001, -1.0, limit - 1.0));
    return part.x <= part.y ? ivec2(first, last) : ivec2(1, 0);
}
