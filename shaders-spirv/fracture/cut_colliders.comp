// Colliders (the paper's Box Cutting, section 3, once more): one workgroup cuts the box around one fragment by the bisectors of
// its cell, by the planes between it and the other islands there, by the planes of its own surface, and by its support planes
// in the fixed directions, in this order. All but the last cut however little they take off: colliders of different cells
// never overlap. A direction cuts only where that shows.
//
// The only fragment of a cell starts from the cell itself, unless that is too large: most cells are whole, and nothing is left
// to be cut.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"
#include "shared/collider.h"
#define ALWAYS_EXACT
#include "lib/exact_cut.glsl"

#define LANES 16
#define PLANES COLLIDER_PLANES
#define CORNERS COLLIDER_CORNERS
#include "lib/exact_store.glsl"
#include "lib/cut_solid.glsl"
#include "lib/support_directions.glsl"
#include "lib/support_plane.glsl"

layout(local_size_x = LANES) in;
READS(0, uint, counts);
READS(1, ivec4, sites);
READS(2, uvec4, cell_offsets);
READS(3, uint, neighbors);
READS(4, uvec2, fragment_list);
READS(5, int, supports);
READS(6, uint, surfaces);
READS(7, uvec2, parting_ranges); // first one and how many, of the fragment's cell
READS(8, uint, partings);
WRITES(9, uint, loose_colliders);
WRITES(10, uvec4, collider_sizes);
READS(11, uvec4, corners); // of the cells, by site ids
layout(push_constant) uniform Push {
    ivec4 box_low;
    ivec4 box_high;
    uint directions;
    float step_size; // model units per grid step
};

const uint kStartPlanes = 48u; // of a cell that is started from; the rest is for what cuts it
const float kSmallestShare = 1.0 / 512.0; // of the fragment's extent, that a direction must take off

struct Candidate {
    Plane plane;
    int64_t deep;
    bool valid;
};

shared ivec4 waiting_d[LANES];
shared uvec4 waiting_r[LANES]; // bound, depth
shared uint wanted;
shared ivec4 normals[SUPPORT_DIRECTIONS / 2]; // of the fixed directions: an array of constants costs its whole length at every look

uint fragment, cell, neighbor_count, parting_count, surface_count, first_direction, lacks;
uint first_neighbor, first_parting, first_corner, corner_count;
bool is_alone;
int shallow; // depth below which a direction does not count, in units of height
ivec3 site;

uvec2 wordsOf(int64_t a) { return uvec2(uint(uint64_t(a)), uint(uint64_t(a) >> 32)); }
int64_t fromWords(uint low, uint high) { return int64_t(uint64_t(low) | (uint64_t(high) << 32)); }

#include "lib/write_collider.glsl"

void fillNormals(uint lane) {
    for (uint k = lane; k < SUPPORT_DIRECTIONS / 2; k += LANES) normals[k] = ivec4(supportDirection(2u * k), 0);
    barrier();
}

ivec3 normalAlong(uint k) { return (k & 1u) == 0u ? normals[k >> 1].xyz : -normals[k >> 1].xyz; }

Plane supportPlane(uint k, uint kind) {
    ivec3 n = normalAlong(k);
    return Plane(8 * n, BOX_BASE + kind, boundAlong(n, supports[fragment * SUPPORT_DIRECTIONS + k], site));
}

void openFragment() {
    uvec2 from = fragment_list[fragment];
    cell = from.y;
    site = sites[cell].xyz;
    first_neighbor = cell_offsets[cell].x;
    neighbor_count = cell_offsets[cell + 1u].x - first_neighbor;
    first_corner = cell_offsets[cell].y;
    corner_count = cell_offsets[cell + 1u].y - first_corner;
    first_parting = parting_ranges[fragment].x;
    parting_count = min(parting_ranges[fragment].y, MOST_PARTINGS);
    is_alone = first_parting == NO_INDEX;
    surface_count = min(surfaces[fragment * SURFACE_WORDS], uint(MOST_SURFACES));
    lacks = surfaces[fragment * SURFACE_WORDS + 1u];
    uint base = fragment * SUPPORT_DIRECTIONS;
    int extent = 1;
    for (uint k = 0u; k < ROLLED(3); k++) extent = max(extent, supports[base + 2u * k] + supports[base + 2u * k + 1u]);
    shallow = int(float(extent) * kSmallestShare) + 1;
}

Plane bisector(uint k) {
    uint id = neighbors[first_neighbor + k];
    ivec3 d = sites[id].xyz - site;
    return Plane(d, id, heightAlong(d, d));
}

Plane wall(uint k) {
    uint axis = k >> 1;
    bool high = (k & 1u) != 0u;
    ivec3 d = ivec3(0), from = inTile(site);
    d[axis] = high ? 1 : -1;
    return Plane(d, BOX_BASE + FACE_DIRECTION, int64_t(2 * (high ? box_high[axis] - from[axis] : from[axis] - box_low[axis])));
}

// Which plane of the cell that is started from a site's id stands for.
uvec3 planesOf(uvec3 ids) {
    uvec3 planes = neighbor_count + (ids - BOX_BASE);
    for (uint k = 0u; k < neighbor_count; k++) {
        uint id = neighbors[first_neighbor + k];
        planes = uvec3(ids.x == id ? k : planes.x, ids.y == id ? k : planes.y, ids.z == id ? k : planes.z);
    }
    return min(planes, uvec3(PLANES - 1));
}

// Its bisectors are then no candidates any more, but all six sides are.
void startFromCell(uint lane) {
    clearSolid(lane, neighbor_count + 6u, corner_count);
    for (uint p = lane; p < neighbor_count + 6u; p += LANES) {
        Plane e = wall(p - min(p, neighbor_count));
        if (p < neighbor_count) e = bisector(p);
        setPlane(p, e);
    }
    barrier();
    for (uint t = lane; t < corner_count; t += LANES) {
        uvec3 p = planesOf(corners[first_corner + t].xyz);
        makeCorner(t, p.x, p.y, p.z);
    }
    barrier();
    neighbor_count = 0u;
    first_direction = 0u;
}

void startSolid(uint lane) {
    first_direction = 6u;
    if (is_alone && neighbor_count + 6u <= kStartPlanes && corner_count <= CORNERS) startFromCell(lane);
    else startFromSides(lane, supportPlane(min(lane, 5u) ^ 1u, FACE_DIRECTION));
}

// Between two islands, if this is one of them: a normal that points from the first to the second, and the bounds of both.
Candidate parting(uint k) {
    uint at = (first_parting + k) * PARTING_WORDS;
    bool second = partings[at + 1u] == fragment, valid = (second || partings[at] == fragment) && partings[at + 2u] != 0u;
    ivec3 d = ivec3(partings[at + 3u], partings[at + 4u], partings[at + 5u]);
    uint bound = at + (second ? 8u : 6u);
    return Candidate(Plane(second ? -d : d, BOX_BASE + FACE_PARTING, fromWords(partings[bound], partings[bound + 1u])),
                     int64_t(0), valid);
}

Candidate surfacePlane(uint k) {
    uint at = fragment * SURFACE_WORDS + 4u + 6u * k;
    ivec3 d = ivec3(surfaces[at], surfaces[at + 1u], surfaces[at + 2u]);
    int64_t bound = boundOf(d, fromWords(surfaces[at + 4u], surfaces[at + 5u]), site);
    return Candidate(Plane(d, BOX_BASE + FACE_SURFACE, bound), int64_t(0), true);
}

Candidate direction(uint k) {
    ivec3 n = normalAlong(k);
    int deep = int(length(vec3(n)) * float(shallow));
    return Candidate(supportPlane(k, FACE_DIRECTION), int64_t(deep), true);
}

uint kindOf(uint k) {
    uint first[3] = uint[3](neighbor_count, neighbor_count + parting_count, neighbor_count + parting_count + surface_count);
    return k < first[0] ? FACE_OF_CELL : (k < first[1] ? FACE_PARTING : (k < first[2] ? FACE_SURFACE : FACE_DIRECTION));
}

// Asks of all lists only what is there.
Candidate candidateAt(uint k, uint total) {
    Candidate c = Candidate(Plane(ivec3(0), 0u, int64_t(0)), int64_t(0), false);
    uint kind = k < total ? kindOf(k) : 4u;
    if (kind == FACE_OF_CELL) c = Candidate(bisector(k), int64_t(0), true);
    if (kind == FACE_PARTING) c = parting(k - neighbor_count);
    if (kind == FACE_SURFACE) c = surfacePlane(k - neighbor_count - parting_count);
    if (kind == FACE_DIRECTION) c = direction(k - neighbor_count - parting_count - surface_count + first_direction);
    return c;
}

// False where it is certain that nothing is cut, and so never will be: the solid only shrinks.
bool mayCut(Candidate c) {
    vec3 d = vec3(c.plane.d);
    float size = length(d), bound = longToFloat(c.plane.r + c.deep);
    bool may = false;
    for (uint t = 0u; t < corner_top; t++) {
        vec4 place = corner_place[t];
        may = may || (liveCorner(t) && dot(d, place.xyz) + size * place.w >= bound - abs(bound) * kPlaceError);
    }
    return may && c.valid;
}

// A candidate a lane, for all lanes to see.
Candidate showCandidate(uint lane, uint k, uint total) {
    Candidate c = candidateAt(k, total);
    waiting_d[lane] = ivec4(c.plane.d, int(c.plane.id));
    waiting_r[lane] = uvec4(wordsOf(c.plane.r), wordsOf(c.deep));
    return c;
}

// The first lane whose candidate may still cut; NO_INDEX where there is none. What a cut leaves is looked at again, which is
// cheaper than to cut in vain.
uint nextToCut(uint lane, Candidate c, inout bool settled) {
    if (lane == 0u) wanted = 0u;
    barrier();
    settled = settled || !mayCut(c);
    if (!settled) atomicOr(wanted, 1u << lane);
    barrier();
    uint next = wanted == 0u ? NO_INDEX : uint(findLSB(wanted));
    barrier();
    spend(corner_top + 2u);
    return next;
}

uint lackOf(uint kind) {
    return kind == FACE_OF_CELL ? COLLIDER_LACKS_CELL
                                : (kind == FACE_PARTING ? COLLIDER_LACKS_PARTINGS
                                                        : (kind == FACE_SURFACE ? COLLIDER_LACKS_SURFACES : COLLIDER_LACKS_DIRECTIONS));
}

// Of candidates that nobody looks at any more, since the turns have run out.
uint lackOfAll(uint first, uint last) {
    uint all_ = 0u, until = kindOf(last);
    for (uint kind = kindOf(first); kind <= until; kind++) all_ |= lackOf(kind);
    return all_;
}

void cutByAll(uint lane) {
    uint total = neighbor_count + parting_count + surface_count + directions - first_direction;
    for (uint first = 0u; first < total; first += LANES) {
        Candidate c = showCandidate(lane, first + lane, total);
        bool settled = false;
        for (uint guard = 0u; guard <= LANES && budget != 0u; guard++) {
            uint at = nextToCut(lane, c, settled);
            if (at == NO_INDEX) break;
            ivec4 d = waiting_d[at];
            uvec4 r = waiting_r[at];
            uint outcome = cutBy(lane, Plane(d.xyz, uint(d.w), fromWords(r.x, r.y)), fromWords(r.z, r.w));
            if (outcome == CUT_REFUSED) lacks |= lackOf(kindOf(first + at));
            settled = settled || lane == at;
        }
        if (budget == 0u) lacks |= lackOfAll(first, min(first + LANES, total) - 1u);
        barrier();
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    fragment = flatGroup();
    if (fragment >= counts[COUNT_FRAGMENTS] || counts[STATUS_FAILED] != 0u) return;
    openFragment();
    fillNormals(lane);
    startSolid(lane);
    cutByAll(lane);
    writeCollider(lane);
}
