// Hulls of fragments that become bodies, about their centers of mass and along their principal axes, a workgroup a fragment.
// Planes keep the normals that they were cut with, which of a sliver its corners cannot tell, through the middle of their
// corners' heights. Edges follow from the loops, in their order: each where it runs to the higher vertex.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/quaternion.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/collider.h"
#include "shared/fragment_record.h"
#include "shared/hull.h"

#define LANES 16 /* most hulls have a few dozen corners */
layout(local_size_x = LANES) in;
READS(0, uint, counts);
READS(1, FragmentRecord, fragments);
READS(2, ivec4, sites);
READS(3, BreakingRecord, breaking);
READS(4, uvec4, rooms);
READS(5, BreakableBody, breakable);
READS(6, ColliderRecord, colliders);
READS(7, ColliderFaceRecord, collider_faces);
READS(8, vec4, collider_vertices);
READS(9, uint, collider_corners);
WRITES(10, HullRecord, hulls);
WRITES(11, vec4, hull_vertices);
WRITES(12, HullFace, hull_faces);
WRITES(13, uint, hull_corners);
WRITES(14, uvec4, hull_edges);
WRITES(15, PieceRecord, pieces);
UPDATES(16, BodyShape, shapes);
#include "lib/whose_fragment.glsl"

const float kAbove = 1.0 + 1e-6; // a ball holds what it is measured by, however that was rounded

shared vec3 places[HULL_VERTICES];
shared uint sides[2 * HULL_EDGES]; // from vertex, to vertex, face: a side of an edge, in whose loop it lies
shared uint faces_of[HULL_VERTICES * HULL_VERTICES / 4 + 1]; // by ends of a side, a byte each: its face
shared vec4 ends[LANES];
shared uint edges_of[LANES];
uint lane;

// What the lanes have between them: sums of the first three, the largest of the last. The same order for all.
vec4 joinEnds(vec4 own) {
    ends[lane] = own;
    barrier();
    vec4 all_ = ends[0];
    for (uint k = 1u; k < ROLLED(LANES); k++) all_ = vec4(all_.xyz + ends[k].xyz, max(all_.w, ends[k].w));
    barrier();
    return all_;
}

// Their mean, and how far the furthest is from the center of mass.
vec4 takeVertices(ColliderRecord collider, BreakableBody body, float unit, uint to) {
    vec4 own = vec4(0.0);
    for (uint v = lane; v < collider.range.w; v += LANES) {
        vec3 p = turned(body.turn, collider_vertices[collider.range.z + v].xyz * unit - body.balance.xyz);
        places[v] = p;
        hull_vertices[to + v] = vec4(p, 0.0);
        own = vec4(own.xyz + p, max(own.w, length(p)));
    }
    vec4 all_ = joinEnds(own);
    return vec4(all_.xyz / float(collider.range.w), all_.w * kAbove);
}

void forgetSides(uint vertices) {
    for (uint k = lane; k < vertices * vertices / 4u + 1u; k += LANES) faces_of[k] = 0u;
}

void noteSide(uint at, uint from, uint to, uint face, uint vertices) {
    uint entry = from * vertices + to;
    sides[at] = from << 16 | to << 8 | face;
    atomicOr(faces_of[entry >> 2], face << (8u * (entry & 3u)));
}

uint faceOfSide(uint from, uint to, uint vertices) {
    uint entry = from * vertices + to;
    return faces_of[entry >> 2] >> (8u * (entry & 3u)) & 0xffu;
}

// Copies the loop and notes its sides; the middle of its corners' heights.
float takeLoop(uint face, uvec2 loop, ColliderRecord collider, vec3 normal, uint to) {
    float low = 1e30, high = -1e30;
    uint before = collider_corners[loop.x + loop.y - 1u];
    for (uint c = 0u; c < loop.y; c++) {
        uint corner = collider_corners[loop.x + c], at = loop.x - collider.info.x + c;
        hull_corners[to + at] = corner;
        noteSide(at, before, corner, face, collider.range.w);
        float height = dot(normal, places[corner]);
        low = min(low, height);
        high = max(high, height);
        before = corner;
    }
    return 0.5 * (low + high);
}

// How near to the center the nearest comes.
float takeFaces(ColliderRecord collider, vec4 turn, vec3 center, uint to, uint to_corners) {
    float near = 1e30;
    for (uint k = lane; k < collider.range.y; k += LANES) {
        ColliderFaceRecord face = collider_faces[collider.range.x + k];
        vec3 normal = normalize(turned(turn, face.plane.xyz));
        float height = takeLoop(k, face.loop.xy, collider, normal, to_corners);
        uint first = to_corners + face.loop.x - collider.info.x;
        hull_faces[to + k] = HullFace(vec4(normal, height), uvec4(first, face.loop.y, 0u, 0u));
        near = min(near, height - dot(normal, center));
    }
    return -joinEnds(vec4(0.0, 0.0, 0.0, -near)).w;
}

float radiusAbout(vec3 center, uint vertices) {
    float radius = 0.0;
    for (uint v = lane; v < vertices; v += LANES) radius = max(radius, distance(places[v], center));
    return joinEnds(vec4(0.0, 0.0, 0.0, radius)).w * kAbove;
}

bool isEdge(uint side) { return side >> 16 < (side >> 8 & 0xffu); }

uint edgesBefore(uint own) {
    edges_of[lane] = own;
    barrier();
    uint before = 0u;
    for (uint k = 0u; k < ROLLED(LANES); k++) before += k < lane ? edges_of[k] : 0u;
    return before;
}

// A lane takes sides that follow each other, so that edges stay in order.
void writeEdges(uint corners, uint vertices, uint to) {
    uint share = (corners + LANES - 1u) / LANES, begin = lane * share, end = min(begin + share, corners), own = 0u;
    for (uint k = begin; k < end; k++) own += isEdge(sides[k]) ? 1u : 0u;
    uint at = to + edgesBefore(own);
    for (uint k = begin; k < end; k++) {
        uint side = sides[k], from = side >> 16, until = side >> 8 & 0xffu;
        if (isEdge(side)) hull_edges[at] = uvec4(from, until, side & 0xffu, faceOfSide(until, from, vertices));
        at += isEdge(side) ? 1u : 0u;
    }
}

void writeRecords(uvec4 room, ColliderRecord collider, vec4 ball, float reach, float thickness) {
    uint faces = room[ROOM_FACES], piece = room[ROOM_PIECE], corners = collider.info.y;
    hulls[piece] = HullRecord(uvec4(VERTICES_A_FACE * faces, faces, CORNERS_A_FACE * faces, EDGES_A_FACE * faces),
                              uvec4(collider.range.w, collider.range.y, corners, corners / 2u), ball);
    pieces[piece].ids = uvec4(piece, room[ROOM_BODY], 0u, 0u);
    shapes[room[ROOM_BODY]].pieces = uvec4(piece, 1u, floatBitsToUint(max(thickness, 0.0)), 0u);
    shapes[room[ROOM_BODY]].inverse_inertia[2].w = reach;
}

void main() {
    uint f = flatGroup();
    lane = gl_LocalInvocationID.x;
    if (f >= counts[COUNT_FRAGMENTS] || counts[STATUS_FAILED] != 0u) return;
    uvec4 room = rooms[f];
    if (room[ROOM_BODY] >= ROOM_OF_DUST) return;
    BreakableBody body = breakable[room[ROOM_BODY]];
    ColliderRecord collider = colliders[f];
    uint faces = room[ROOM_FACES];
    float unit = inversePower(breaking[objectOfFragment(f)].center.w);
    forgetSides(collider.range.w);
    vec4 mean = takeVertices(collider, body, unit, VERTICES_A_FACE * faces);
    float near = takeFaces(collider, body.turn, mean.xyz, faces, CORNERS_A_FACE * faces);
    float radius = radiusAbout(mean.xyz, collider.range.w);
    writeEdges(collider.info.y, collider.range.w, EDGES_A_FACE * faces);
    if (lane == 0u) writeRecords(room, collider, vec4(mean.xyz, radius), mean.w, near);
}
