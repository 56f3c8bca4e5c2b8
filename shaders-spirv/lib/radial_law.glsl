// How many spokes and rings a blow on a plate pays for. What both are long follows from one length, the reach: how far it is from
// the blow to the rim on the average of all directions, the integral of 1/r over the plate, over 2 pi. n spokes are n reaches long.
// Rings whose radii grow by the ratio q, the first boundary at m, are, as their phase goes evenly through a step,
//   2 pi (reach / ln q - m / (q - 1))
// long in all: in every direction the last one lies somewhere in the last step before the rim. Pieces of rings are straight, which
// makes them longer than arcs, by 1 + 3.7 / n^2; and of the last ones those are missing beyond which there would be but a sliver
// (lib/draw_radial.glsl), about an eighth of a step.
struct Rays {
    uint spokes;
    uint rings;
    float ratio;
    float innermost; // m, radius of the first ring's sites
};

const float kSpokes = 2.0;      // at 1 m/s; chosen
const float kInnermost = 24.0;  // of a plate's side: the first ring's share
const float kMostRatio = 4.0, kLeastRatio = 1.05;
const float kDisk = 0.5642;     // reach from the middle of a disk, of the side of a square as large
const float kSliver = 0.125;    // of a ring's width
const float kMostOblong = 6.0;  // times as long around the blow as wide is the longest piece; chosen

float lengthOfRings(float reach, float innermost, float ratio, float spokes) {
    float last = reach / (1.0 + kSliver * (ratio - 1.0)), first = 0.5 * innermost * (ratio + 1.0);
    return 6.2832 * (1.0 + 3.7 / (spokes * spokes)) * (last / log(ratio) - first / (ratio - 1.0));
}

// Finer rings would be splinters that lie across the way from the blow.
float leastRatioFor(float spokes) { return max(kLeastRatio, 1.0 + 6.2832 / (kMostOblong * spokes)); }

// The ratio whose rings are so long: they are shorter the larger it is.
float ratioFor(float length_, float reach, float innermost, float spokes) {
    float low = leastRatioFor(spokes), high = kMostRatio;
    for (uint k = 0u; k < 24u; k++) {
        float middle = 0.5 * (low + high);
        bool longer = lengthOfRings(reach, innermost, middle, spokes) > length_;
        low = longer ? middle : low;
        high = longer ? high : middle;
    }
    return high;
}

float firstRadius(float innermost, float ratio, float phase) { return innermost * pow(ratio, phase - 0.5); }

uint ringsUpTo(float furthest, float innermost, float ratio, float phase) {
    float first = 0.5 * firstRadius(innermost, ratio, phase) * (1.0 + ratio);
    return 1u + uint(max(ceil(log(furthest / first) / log(ratio)), 0.0));
}

// From `least` on, as many as it takes for what is paid for not to be more than that with the finest rings, and there is room for.
float spokesFor(float least, float length_, float reach, float innermost, float furthest, uint most, float phase) {
    float spokes = least;
    for (float more = 1024.0; more >= 1.0; more *= 0.5) {
        float fewer = spokes + more - 1.0, ratio = leastRatioFor(spokes + more);
        bool is_paid = fewer * reach + lengthOfRings(reach, innermost, leastRatioFor(fewer), fewer) < length_;
        bool fits = (spokes + more) * float(ringsUpTo(furthest, innermost, ratio, phase)) <= float(most);
        if (is_paid && fits) spokes += more;
    }
    return spokes;
}

// Spokes are as many as the root of the speed (Vandenberghe, Vermorel, Villermaux, Star-shaped crack pattern of broken windows,
// 2013), more where the rim is near and little of the plate lies in many directions; what they leave goes into rings, and where it pays
// for none, or for more than the finest ones, into spokes. Where there is no room for so many cells, rings are fewer and wider. `length_`: of crack that is paid for;
// `furthest`: the rim; `most`: cells; chance and phase from 0 to 1.
Rays raysFor(float length_, float speed, float side, float reach, float furthest, uint most, float chance, float phase) {
    float crowded = clamp(kDisk * side / reach, 1.0, 4.0), spokes = min(max(floor(kSpokes * crowded * sqrt(speed)), 3.0), float(max(most, 2u)));
    float innermost = min(side / kInnermost, 0.25 * reach);
    spokes = spokesFor(spokes, length_, reach, innermost, furthest, most, phase);
    float left = length_ - spokes * reach;
    if (left < lengthOfRings(reach, innermost, kMostRatio, spokes))
        return Rays(uint(clamp(floor(length_ / reach + chance), 2.0, float(max(most, 2u)))), 1u, kMostRatio, innermost);
    float ratio = ratioFor(left, reach, innermost, spokes);
    uint rings = ringsUpTo(furthest, innermost, ratio, phase), room = max(most / uint(spokes), 1u);
    for (uint k = 0u; k < 40u && rings > room && ratio < kMostRatio; k++) {
        ratio = 1.0 + 1.1 * (ratio - 1.0);
        rings = ringsUpTo(furthest, innermost, ratio, phase);
    }
    return Rays(uint(spokes), min(rings, room), ratio, firstRadius(innermost, ratio, phase));
}

// Of a triangle's integral of 1/r over its part on the left of a side: between two rays and the side it is as long as the rays are
// on the average.
float underSide(vec2 from, vec2 to) {
    vec2 way = to - from;
    float size = length(way), away = size > 0.0 ? abs(from.x * to.y - from.y * to.x) / size : 0.0;
    if (away <= 1e-6 * size) return 0.0;
    float sum = asinh(dot(to, way) / (size * away)) - asinh(dot(from, way) / (size * away));
    return from.x * to.y - from.y * to.x < 0.0 ? -away * sum : away * sum;
}

float inverseDistanceOver(vec2 a, vec2 b, vec2 c) { return abs(underSide(a, b) + underSide(b, c) + underSide(c, a)); }
