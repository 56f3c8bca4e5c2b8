// Where more than two triangles meet at an edge, pairs those that bound the same wedge of solid, like brackets around the edge. A lane
// an edge. Angles are compared by the signs of exact determinants on the grid. Faces that lie on each other but for rounding have
// one angle, at which one solid ends before the next begins.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/wide.glsl"
#include "lib/spoke.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ivec4, grid_vertices);
READS(2, uint, triangles);
READS(3, uvec2, sides);
READS(4, uint, first_sides);
READS(5, uint, first_vertices);
READS(6, uint, heads);
UPDATES(7, uint, links); // side + 1; 0: none
UPDATES(8, uint, below); // in the stack of wedges that have begun, as in links
UPDATES(9, uint, wedges); // the lower of the two sides that bound it

Edge edge;

ivec3 armOf(uint s) { return grid_vertices[triangles[s - s % 3u + (s % 3u + 2u) % 3u]].xyz - edge.low; }

// The solid lies on the side of greater angles: the triangle runs down the edge.
bool opens(uint s) { return first_vertices[triangles[s]] != sides[s].x; }

// The lowest side whose triangle has an area.
uint zeroOf(uint head, out uint count) {
    uint zero = NO_INDEX;
    count = 0u;
    for (uint h = head; h != 0u && count <= MOST_AROUND_EDGE;) {
        uint s = h - 1u;
        if (s < zero && !isAlong(edge, armOf(s))) zero = s;
        h = links[s];
        count++;
    }
    return zero;
}

bool precedes(uint a, uint b) {
    int order = orderOf(edge, armOf(a), armOf(b));
    return order != 0 ? order < 0 : a < b;
}

// Puts a side into the list in order, and returns the head of the list.
uint inserted(uint head, uint s) {
    uint before = 0u, after = head;
    for (uint turn = 0u; turn < MOST_AROUND_EDGE && after != 0u; turn++) {
        if (!precedes(after - 1u, s)) break;
        before = after;
        after = links[after - 1u];
    }
    links[s] = after;
    if (before != 0u) links[before - 1u] = s + 1u;
    return before != 0u ? head : s + 1u;
}

uint sorted(uint unsorted) {
    uint head = 0u;
    for (uint turn = 0u; turn < MOST_AROUND_EDGE && unsorted != 0u; turn++) {
        uint s = unsorted - 1u;
        unsorted = links[s];
        head = inserted(head, s);
    }
    return head;
}

// Makes the list a ring, and returns a side that does not lie on the one before it, or 0.
uint beginningOf(uint head, uint count) {
    uint at = head, beginning = 0u;
    for (uint turn = 0u; turn < count; turn++) {
        uint next = links[at - 1u];
        if (next == 0u) {
            links[at - 1u] = head;
            next = head;
        }
        bool apart = !liesOn(edge, armOf(at - 1u), armOf(next - 1u));
        beginning = apart && beginning == 0u ? next : beginning;
        at = next;
    }
    return beginning;
}

struct Sublist {
    uint first, last;
};

void append(inout Sublist list, Sublist more) {
    if (more.first == 0u) return;
    if (list.first == 0u) list.first = more.first;
    else links[list.last - 1u] = more.first;
    list.last = more.last;
}

// The list once more, with those that end a wedge before those that begin one at each angle.
uint endsFirst(uint beginning, uint count) {
    Sublist list = Sublist(0u, 0u), opening = Sublist(0u, 0u);
    uint at = beginning, before = 0u;
    for (uint turn = 0u; turn < count; turn++) {
        uint next = links[at - 1u];
        if (before != 0u && !liesOn(edge, armOf(before - 1u), armOf(at - 1u))) {
            append(list, opening);
            opening = Sublist(0u, 0u);
        }
        Sublist alone = Sublist(at, at);
        if (opens(at - 1u)) append(opening, alone);
        else append(list, alone);
        before = at;
        at = next;
    }
    append(list, opening);
    links[list.last - 1u] = list.first;
    return list.first;
}

void pair(uint a, uint b) {
    wedges[a] = min(a, b);
    wedges[b] = min(a, b);
}

void forget(uint first, uint count) {
    uint at = first;
    for (uint turn = 0u; turn < count; turn++) {
        wedges[at - 1u] = NO_INDEX;
        at = links[at - 1u];
    }
}

// The second turn around the edge ends what the first left open.
void match(uint first, uint count) {
    uint top = 0u, at = first;
    for (uint turn = 0u; turn < 2u * count; turn++) {
        uint s = at - 1u;
        bool begins = opens(s), is_open = wedges[s] == NO_INDEX;
        if (begins && turn < count) {
            below[s] = top;
            top = at;
        }
        if (!begins && is_open && top != 0u) {
            uint mate = top - 1u;
            top = below[mate];
            pair(s, mate);
        }
        at = links[s];
    }
}

// A side without a counterpart is a wedge of its own.
void leaveAlone(uint first, uint count) {
    uint at = first;
    for (uint turn = 0u; turn < count; turn++) {
        if (wedges[at - 1u] == NO_INDEX) wedges[at - 1u] = at - 1u;
        at = links[at - 1u];
    }
}

void main() {
    uint s = flatIndex();
    if (s >= counts[COUNT_MESH_CORNERS] || counts[STATUS_FAILED] != 0u) return;
    uint head = heads[s]; // of an edge that more than two triangles have
    if (head == 0u || first_sides[s] != s || links[head - 1u] == 0u || links[links[head - 1u] - 1u] == 0u) return;
    edge = edgeFrom(grid_vertices[sides[s].x].xyz, grid_vertices[sides[s].y].xyz);
    uint count, zero = zeroOf(head, count);
    if (zero == NO_INDEX || count > MOST_AROUND_EDGE) return;
    edge.zero = armOf(zero);
    uint beginning = beginningOf(sorted(head), count);
    if (beginning == 0u) return;
    uint first = endsFirst(beginning, count);
    forget(first, count);
    match(first, count);
    leaveAlone(first, count);
}
