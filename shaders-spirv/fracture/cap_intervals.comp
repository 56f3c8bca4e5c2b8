// Parts of Voronoi edges that lie inside the solid. Each bounds three caps. Runs twice, to count and to fill.
//
// The walk keeps the depth and the entries that are still open; of several crossings at one place it takes first the one
// that keeps the depth at 0 or 1, so that touching surfaces pair up.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(constant_id = 0) const uint kFill = 0u;
#define MAX_OPEN 16
FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uvec4, cell_offsets);
READS(2, uint, neighbors);
READS(3, uvec4, edge_sites);
READS(4, uvec2, edge_ends);
READS(5, uvec2, links);         // y: depth
READS(6, uint, edge_triple_offsets);
READS(7, uvec2, ordered_triples);
READS(8, int, triple_signs);
UPDATES(9, uint, interval_counts);
READS(10, uint, interval_offsets);
UPDATES(11, uint, face_counts); // while filling: cursors
READS(12, uint, face_offsets);
WRITES(13, uvec4, segments);    // from, to, source, 1 if it lies in the mesh

uvec3 faces;
uint made, base, first_triple, first_voronoi;

uint faceOf(uint i, uint j) {
    uint found = NO_INDEX, last = cell_offsets[i + 1u].x;
    for (uint k = cell_offsets[i].x; k < last; k++) found = neighbors[k] == j ? k : found;
    return found;
}

void addInterval(uint a, uint b) {
    if (kFill != 0u) {
        for (uint f = 0u; f < 3u; f++) {
            uint at = face_offsets[faces[f]] + atomicAdd(face_counts[faces[f]], 1u);
            segments[at] = f == 1u ? uvec4(b, a, 3u * (base + made) + f, 0u) : uvec4(a, b, 3u * (base + made) + f, 0u);
        }
    }
    made++;
}

// Of the crossings [c, end) of one class that are not taken yet, the one to take next.
uint chooseCrossing(uint c, uint end, uint taken, int depth) {
    uint pick = NO_INDEX;
    for (uint g = c; g < end; g++) {
        bool is_open = ((taken >> min(g - c, 31u)) & 1u) == 0u;
        bool enters = triple_signs[ordered_triples[g].x] < 0;
        bool fits = (depth <= 0) == enters;
        if (is_open && pick == NO_INDEX) pick = g;
        else if (is_open && fits && ((depth <= 0) != (triple_signs[ordered_triples[pick].x] < 0))) pick = g;
    }
    return pick;
}

void main() {
    uint e = flatIndex();
    if (e >= counts[COUNT_VORONOI_EDGES] || counts[STATUS_FAILED] != 0u) return;
    uvec4 s = edge_sites[e];
    uvec2 ends = edge_ends[e];
    first_triple = counts[COUNT_MESH_VERTICES] + counts[COUNT_CROSSINGS];
    first_voronoi = first_triple + counts[COUNT_TRIPLES];
    faces = uvec3(faceOf(s.x, s.y), faceOf(s.x, s.z), faceOf(s.y, s.z));
    made = 0u;
    base = kFill != 0u ? interval_offsets[e] : 0u;
    int depth = ends.x == NO_INDEX ? 0 : int(links[ends.x].y), final_depth = ends.y == NO_INDEX ? 0 : int(links[ends.y].y);
    uint open[MAX_OPEN];
    int opened = 0; // > 0: entries that wait for an exit; < 0: exits that came before their entry
    bool bad = any(equal(faces, uvec3(NO_INDEX))) || abs(depth) > MAX_OPEN;
    for (; opened < min(depth, MAX_OPEN); opened++) open[opened] = first_voronoi + ends.x;
    for (; opened > max(depth, -MAX_OPEN); opened--) open[-opened] = first_voronoi + ends.x;
    uint c = edge_triple_offsets[e], last = edge_triple_offsets[e + 1u];
    uint class_end = c, taken = 0u, class_first = c;
    for (; c < last && !bad; c++) {
        if (c >= class_end) {
            class_first = c;
            taken = 0u;
            for (class_end = c + 1u; class_end < last && ordered_triples[class_end].y == ordered_triples[c].y;) class_end++;
        }
        uint pick = chooseCrossing(class_first, class_end, taken, depth);
        taken |= 1u << min(pick - class_first, 31u);
        uint triple = ordered_triples[pick].x, id = first_triple + triple;
        bool enters = triple_signs[triple] < 0;
        if (enters) {
            if (opened < 0) addInterval(id, open[-opened - 1]);
            else open[min(opened, MAX_OPEN - 1)] = id;
            opened++;
            depth++;
        } else {
            if (opened > 0) addInterval(open[opened - 1], id);
            else open[min(-opened, MAX_OPEN - 1)] = id;
            opened--;
            depth--;
        }
        bad = abs(opened) >= MAX_OPEN;
    }
    bad = bad || depth != final_depth || (opened != 0 && ends.y == NO_INDEX);
    for (; opened > 0 && !bad; opened--) addInterval(open[opened - 1], first_voronoi + ends.y);
    for (; opened < 0 && !bad; opened++) addInterval(first_voronoi + ends.y, open[-opened - 1]);
    if (kFill == 0u) {
        if (bad) {
            atomicAdd(counts[STATUS_BAD_DEPTH], 1u);
            atomicOr(counts[STATUS_FAILED], FAILED_CLIP);
        }
        interval_counts[e] = made;
        if (!bad && made > 0u) {
            for (uint f = 0u; f < 3u; f++) atomicAdd(face_counts[faces[f]], made);
        }
    }
}
