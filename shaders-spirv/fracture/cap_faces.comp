// Triangulates the caps that are one simple loop of few corners, a face a lane: most are. The rest goes to
// cap_fans: several loops, holes, touching corners, long loops, no ear to be found, or an outline that
// turns back on itself or goes round more than once.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

#define SMALL SMALL_FACE
FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, ivec4, sites);
READS(2, uint, faces);          // neighbor entries that carry caps
READS(3, uint, neighbors);
READS(4, uint, face_cells);     // lower cell of each neighbor entry
READS(5, uint, face_offsets);
READS(6, uvec4, segments);
READS(7, uint, welded);
READS(8, uint, points);
WRITES(9, uint, loose_caps);    // three words a slot; a slot for every segment, and then those of large faces
WRITES(10, uint, cap_counts);
WRITES(11, uint, wide_faces);
WRITES(12, uint, cap_slots);    // first slot of each face
#include "lib/cap_plane.glsl"

ivec2 place[SMALL];
uint name[SMALL];
uint next_of[SMALL];
uint previous_of[SMALL];

// Ear of the loop at k: a left turn with no other corner in its closed triangle. Corners that turn left cannot be the
// first to enter, so only the others are looked at.
bool isEar(uint k, uint reflex) {
    uint a = previous_of[k], c = next_of[k];
    ivec2 pa = place[a], pb = place[k], pc = place[c];
    bool ear = turn(pa, pb, pc) > 0;
    uint others = reflex & ~((1u << a) | (1u << k) | (1u << c));
    for (uint guard = 0u; guard < SMALL && others != 0u && ear; guard++) {
        uint q = uint(findLSB(others));
        others &= others - 1u;
        ivec2 x = place[q];
        ear = !inTriangle(pa, pb, pc, x);
    }
    return ear;
}

void main() {
    uint at = flatIndex();
    if (at >= counts[COUNT_FACES] || counts[STATUS_FAILED] != 0u) return;
    uint f = faces[at], first = face_offsets[f], n = face_offsets[f + 1u] - first;
    CapPlane plane = capPlane(sites[face_cells[f]].xyz, sites[neighbors[f]].xyz);
    bool small = n <= SMALL;
    uint count = small ? n : 0u, start = 0u, lowest = NO_INDEX, size = 0u;
    uint ends[SMALL];
    for (uint k = 0u; k < count; k++) {
        uvec4 s = segments[first + k];
        uint a = welded[s.x], b = welded[s.y];
        if (a != b) {
            name[size] = a;
            ends[size] = b;
            place[size] = ivec2(capCoordinate(a, plane.u), capCoordinate(a, plane.w));
            if (s.z < lowest) {
                lowest = s.z;
                start = size;
            }
            size++;
        }
    }
    // Chain: every corner must be left exactly once, and one walk must visit them all.
    bool simple = small;
    for (uint k = 0u; k < size; k++) {
        uint follow = NO_INDEX, exits = 0u;
        for (uint s = 0u; s < size; s++) {
            if (name[s] == ends[k]) {
                follow = s;
                exits++;
            }
        }
        simple = simple && exits == 1u;
        next_of[k] = simple ? follow : 0u;
        if (simple) previous_of[follow] = k;
    }
    uint walk = start, visited = 0u;
    for (uint k = 0u; k < size && simple; k++) {
        walk = next_of[walk];
        visited++;
        if (walk == start) break;
    }
    simple = simple && visited == size && (size == 0u || walk == start);
    uint made = 0u, reflex = 0u, left = simple ? size : 0u, corner = start, failures = 0u;
    int rounds = 0;
    for (uint k = 0u; k < left; k++) {
        if (turn(place[previous_of[k]], place[k], place[next_of[k]]) <= 0) reflex |= 1u << k;
        simple = simple && !isSpike(place[previous_of[k]], place[k], place[next_of[k]]);
        rounds += roundTurn(place[previous_of[k]], place[k], place[next_of[k]]);
    }
    simple = simple && (left == 0u || rounds == 1);
    left = simple ? left : 0u;
    for (uint step = 0u; step < SMALL * SMALL && left > 2u && failures <= left; step++) {
        if (left == 3u || isEar(corner, reflex)) {
            uint a = previous_of[corner], c = next_of[corner];
            bool flat_or_turned = turn(place[a], place[corner], place[c]) <= 0;
            if (left == 3u && flat_or_turned) {
                failures = SMALL + 1u;
                break;
            }
            uint slot = 3u * (first + made);
            loose_caps[slot] = name[a];
            loose_caps[slot + 1u] = name[corner];
            loose_caps[slot + 2u] = name[c];
            made++;
            next_of[a] = c;
            previous_of[c] = a;
            reflex &= ~((1u << corner) | (1u << a) | (1u << c));
            if (turn(place[previous_of[a]], place[a], place[c]) <= 0) reflex |= 1u << a;
            if (turn(place[a], place[c], place[next_of[c]]) <= 0) reflex |= 1u << c;
            left--;
            failures = 0u;
            corner = next_of[c];
        } else {
            corner = next_of[corner];
            failures++;
        }
    }
    bool done = simple && (left <= 2u || size <= 2u);
    cap_counts[at] = done ? made : 0u;
    cap_slots[at] = first;
    if (!done) wide_faces[atomicAdd(counts[COUNT_WIDE_FACES], 1u)] = at;
}
