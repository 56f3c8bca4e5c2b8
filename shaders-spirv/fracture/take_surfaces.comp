// Planes of a fragment's own surface behind which all of the fragment lies: all of them where it is convex, and elsewhere those
// that its convex hull has too. A workgroup a fragment takes the largest triangle that is left, measures the fragment along
// its normal, and strikes out what lies in that plane and what the furthest corner shows to be no plane of the hull; so a flat
// side costs one plane, however many triangles it has. Ends after MOST_SURFACES planes, or when SURFACE_VISITS are used up, or
// where the first few rounds leave no hope that so many will do, or show that most of the surface is not convex; then only
// the largest few planes are kept.
//
// A plane is placed by the fragment's height along a rounded normal, never by its triangle: it cannot cut into the fragment.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/collider.h"
#include "lib/wide.glsl"
#include "lib/support_plane.glsl"

#define LANES 16 /* most fragments have a few dozen triangles */
layout(local_size_x = LANES) in;
READS(0, uint, counts);
READS(1, uvec2, fragment_list);
READS(2, uint, component_start);
READS(3, uint, order);
READS(4, uvec4, pieces);
READS(5, uint, sources);
READS(6, vec4, positions);
READS(7, uint, triangles);
READS(8, float, mesh_positions);
READS(9, int, supports);
UPDATES(10, uint, marks); // by place in `order`: not asked any more
WRITES(11, uint, surfaces);
layout(push_constant) uniform Push { float fine; }; // units of height in a model unit

const uint kMostRounds = 96u;
const uint kTrialRounds = 4u;
const uint kTrialFailures = 2u;
const uint kMostTriangles = 1u << 18; // that one workgroup goes through twice, in the turns that Mesa's software device allows

shared int64_t heights[LANES];
shared ivec4 places[LANES];
shared uint largest_area, largest_at, left_count;

struct Found {
    ivec3 d;         // normal of the last plane that was tried
    int64_t height;  // of the fragment along it
    ivec3 furthest;  // its corner there
    bool taken;
};

float shallow; // units of height within which a triangle is taken to lie in a plane of the hull
float flat_;   // and in a plane that has been taken

ivec3 cornerAt(uint id) { return fineOf(positions[id].xyz, fine); }

ivec3 modelCorner(uint t, uint k) {
    uint v = 3u * triangles[3u * t + k];
    return fineOf(vec3(mesh_positions[v], mesh_positions[v + 1u], mesh_positions[v + 2u]), fine);
}

void measureTolerance(uint fragment) {
    uint base = fragment * SUPPORT_DIRECTIONS;
    int extent = 1;
    for (uint k = 0u; k < ROLLED(3); k++) extent = max(extent, supports[base + 2u * k] + supports[base + 2u * k + 1u]);
    shallow = float(extent) / 512.0 + 16.0;
    flat_ = float(extent) / 4194304.0 + 8.0;
}

bool reaches(Found last, uint id, float bound) {
    int64_t below = last.height - heightAlong(last.d, cornerAt(id));
    return float(uint(uint64_t(below) >> 32)) * 4294967296.0 + float(uint(below)) <= bound;
}

bool liesIn(Found last, uvec4 piece) {
    float bound = flat_ * length(vec3(last.d));
    return reaches(last, piece.x, bound) && reaches(last, piece.y, bound) && reaches(last, piece.z, bound);
}

bool passedBy(Found last, uint t) {
    ivec3 a = modelCorner(t, 0u);
    vec3 n = cross(vec3(modelCorner(t, 1u) - a), vec3(modelCorner(t, 2u) - a));
    return dot(n, vec3(last.furthest - a)) > shallow * length(n);
}

// Strikes out what the last plane has settled, and finds the largest triangle that is left. Of a clipped triangle's fan only the
// first counts as left.
void findLargest(uint lane, uint first, uint last, uint round, Found found) {
    if (lane == 0u) {
        largest_area = 0u;
        largest_at = NO_INDEX;
        left_count = 0u;
    }
    barrier();
    uint best = 0u, at = NO_INDEX, left = 0u;
    for (uint k = first + lane; k < last; k += LANES) {
        uint t = order[k], source = sources[t];
        uvec4 piece = pieces[t];
        bool fresh = k == first || sources[order[max(k, 1u) - 1u]] != source, done = round != 0u && marks[k] != 0u;
        done = done || (round != 0u && (passedBy(found, source) || (found.taken && liesIn(found, piece))));
        ivec3 a = cornerAt(piece.x);
        float area = length(cross(vec3(cornerAt(piece.y) - a), vec3(cornerAt(piece.z) - a)));
        uint key = done ? 0u : floatBitsToUint(area);
        if (key > best) {
            best = key;
            at = k;
        }
        marks[k] = done ? 1u : 0u;
        left += fresh && !done ? 1u : 0u;
    }
    atomicMax(largest_area, best);
    atomicAdd(left_count, left);
    barrier();
    if (best != 0u && best == largest_area) atomicMin(largest_at, at);
    barrier();
    if (at == largest_at && at != NO_INDEX) marks[at] = 1u;
}

// Where the caps of a component begin: its pieces are in the order in which they were listed.
uint firstCap(uint first, uint last) {
    uint low = first, high = last;
    for (uint turn = 0u; turn < 32u && low < high; turn++) {
        uint middle = (low + high) / 2u;
        bool is_cap = (sources[order[middle]] & INNER_BIT) != 0u;
        low = is_cap ? low : middle + 1u;
        high = is_cap ? middle : high;
    }
    return low;
}

uint bitsOf(int64_t a) {
    uint64_t m = uint64_t(isNegative(a) ? -a : a);
    uint high = uint(m >> 32), low = uint(m);
    return high != 0u ? 33u + uint(findMSB(high)) : (low != 0u ? 1u + uint(findMSB(low)) : 0u);
}

// The normal of a triangle of the model, to 21 bits and a sign.
ivec3 normalOf(uint t) {
    ivec3 a = modelCorner(t, 0u), u = modelCorner(t, 1u) - a, v = modelCorner(t, 2u) - a;
    int64_t n[3] = int64_t[3](int64_t(u.y) * int64_t(v.z) - int64_t(u.z) * int64_t(v.y),
                              int64_t(u.z) * int64_t(v.x) - int64_t(u.x) * int64_t(v.z),
                              int64_t(u.x) * int64_t(v.y) - int64_t(u.y) * int64_t(v.x));
    uint bits = max(bitsOf(n[0]), max(bitsOf(n[1]), bitsOf(n[2]))), shift = bits > 21u ? bits - 21u : 0u;
    int64_t half_ = shift > 0u ? int64_t(1) << (shift - 1u) : int64_t(0);
    return ivec3(int((n[0] + half_) >> shift), int((n[1] + half_) >> shift), int((n[2] + half_) >> shift));
}

void raise(inout Found found, uint id) {
    ivec3 p = cornerAt(id);
    int64_t height = heightAlong(found.d, p);
    bool higher = signOf(height - found.height) > 0;
    found.height = higher ? height : found.height;
    found.furthest = higher ? p : found.furthest;
}

// No loop over the three corners: turns are few (kMostTriangles).
Found measureAlong(ivec3 d, uint lane, uint first, uint last) {
    Found found = Found(d, int64_t(-0x3fffffff) * int64_t(0x3fffffff), ivec3(0), false);
    for (uint k = first + lane; k < last; k += LANES) {
        uvec4 piece = pieces[order[k]];
        raise(found, piece.x);
        raise(found, piece.y);
        raise(found, piece.z);
    }
    heights[lane] = found.height;
    places[lane] = ivec4(found.furthest, 0);
    barrier();
    for (uint width = ROLLED(LANES / 2u); width > 0u; width >>= 1) {
        if (lane < width && signOf(heights[lane + width] - heights[lane]) > 0) {
            heights[lane] = heights[lane + width];
            places[lane] = places[lane + width];
        }
        barrier();
    }
    found = Found(d, heights[0], places[0].xyz, false);
    barrier();
    return found;
}

void savePlane(uint fragment, uint k, Found found) {
    uint at = fragment * SURFACE_WORDS + 4u + 6u * k;
    surfaces[at] = uint(found.d.x);
    surfaces[at + 1u] = uint(found.d.y);
    surfaces[at + 2u] = uint(found.d.z);
    surfaces[at + 4u] = uint(uint64_t(found.height));
    surfaces[at + 5u] = uint(uint64_t(found.height) >> 32);
}

void main() {
    uint f = flatGroup(), lane = gl_LocalInvocationID.x;
    if (f >= counts[COUNT_FRAGMENTS] || counts[STATUS_FAILED] != 0u) return;
    uint c = fragment_list[f].x, first = component_start[c], last = component_start[c + 1u], caps = firstCap(first, last), count = 0u;
    uint rounds = last - first > kMostTriangles ? 0u : clamp(SURFACE_VISITS / (last - first), 1u, kMostRounds);
    measureTolerance(f);
    Found found = Found(ivec3(0), int64_t(0), ivec3(0), false);
    bool complete = false, hopeless = false;
    uint first_left = 0u, failed = 0u;
    for (uint round = 0u; round < rounds && !complete && !hopeless; round++) {
        findLargest(lane, first, caps, round, found);
        uint at = largest_at, left = left_count;
        barrier();
        first_left = round == 0u ? left : first_left;
        complete = at == NO_INDEX;
        // At this rate there would be no end of them: a finely meshed surface is no few planes.
        uint room = MOST_SURFACES - count, struck = first_left - left;
        bool too_slow = round >= kTrialRounds && left > room && left * round > struck * room;
        hopeless = !complete && (room == 0u || too_slow || failed > max(count, kTrialFailures));
        uint t = complete ? 0u : sources[order[min(at, last - 1u)]];
        found = measureAlong(normalOf(t), lane, first, complete || hopeless ? first : last);
        found.taken = !complete && !hopeless && found.d != ivec3(0) && !passedBy(found, t);
        if (found.taken && lane == 0u) savePlane(f, count, found);
        count += found.taken ? 1u : 0u;
        failed += found.taken || complete || hopeless ? 0u : 1u;
    }
    if (lane != 0u) return;
    surfaces[f * SURFACE_WORDS] = complete ? count : min(count, kTrialRounds);
    surfaces[f * SURFACE_WORDS + 1u] = complete || failed != 0u ? 0u : COLLIDER_LACKS_SURFACES;
}
