// The points in which a pair touches along its axis, a lane a pair: of two faces the corners of what lies over each other, four at
// most, of two edges the points nearest to each other.
//
// Edges of faces that all but lie on each other are both: the best axis changes between them and the faces from step to step, and
// a body held by four points in one step and by another single one in the next never comes to rest. So where a face of either
// edge faces the other hull squarely enough, the points are those of the two faces, along the axis of the edges.
//
// B is looked at where it is at the time of impact; arms and separations are those of now, so that a pair that will meet in this
// step has points with the way that is left along the normal as their separation.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/component.glsl"
#include "shared/body.h"
#include "shared/contact.h"
#include "shared/hull.h"
#include "shared/narrow_phase.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec2, pairs);
READS(2, PieceRecord, pieces);
READS(3, BodyState, bodies);
READS(4, HullRecord, hulls);
READS(5, vec4, hull_vertices);
READS(6, HullFace, hull_faces);
READS(7, uint, hull_corners);
READS(8, uvec4, hull_edges);
READS(9, AxisRecord, axes);
WRITES(10, Manifold, manifolds);
READS(11, FirstHits, first_hits);
layout(push_constant) uniform Push { NarrowPhasePush push; };

#include "lib/hull_pair.glsl"

const float kFar = 3e38;
HullPair pair;
AxisRecord found;
bool is_swept;

#include "lib/contact_candidates.glsl"
#include "lib/contact_reduction.glsl"

// Corners that lie beside a face by less than this share of the smaller hull are over it, so that boxes that rest on each other
// edge on edge touch in their corners.
const float kSlackShare = 1e-4;

struct Touch {
    vec3 on_a, on_b; // in the pair's frame, at the time of impact
    uint name;
};

// The faces whose candidates are chosen from.
struct Facing {
    bool a_leads;
    uint reference_face, incident_face;
};

Facing facing;
uvec4 picked = uvec4(NO_INDEX); // candidates
uint touch_count = 0u;

vec3 shiftedCorner(bool of_a, uint vertex) { return cornerAt(pair, of_a, vertex) + (of_a ? vec3(0.0) : found.shift.xyz); }

HullFace faceOf(bool of_a, uint face) { return hull_faces[(of_a ? pair.hull[0].first.y : pair.hull[1].first.y) + face]; }

uint loadReference(bool of_a, uint face) {
    uvec2 loop = faceOf(of_a, face).loop.xy;
    uint count = min(loop.y, FACE_CORNERS);
    for (uint c = 0u; c < count; c++) reference_at[c] = inPlane(shiftedCorner(of_a, hull_corners[loop.x + c])).xy;
    return count;
}

uint loadIncident(bool of_a, uint face) {
    uvec2 loop = faceOf(of_a, face).loop.xy;
    uint count = min(loop.y, FACE_CORNERS);
    for (uint c = 0u; c < count; c++) incident_at[c] = inPlane(shiftedCorner(of_a, hull_corners[loop.x + c]));
    return count;
}

vec3 normalOf(bool of_a, uint face) {
    vec3 own = faceOf(of_a, face).plane.xyz;
    return of_a ? own : pair.axes[1] * own;
}

#include "lib/level_faces.glsl"
#include "lib/hidden_hit.glsl"

// Wants the plane set.
void gatherCandidates() {
    slack = kSlackShare * pair.smaller;
    float tilt = tiltInStep();
    bool tips = tilt > kLeastTilt && liesOnGround();
    reference_count = loadReference(facing.a_leads, facing.reference_face);
    if (tips) facing.incident_face = faceBelowCenter(tilt);
    incident_count = loadIncident(!facing.a_leads, facing.incident_face);
    vec3 n = normalOf(!facing.a_leads, facing.incident_face);
    candidate_count = 0u;
    addIncidentEdges();
    addReferenceCorners(vec3(dot(plane.u, n), dot(plane.v, n), dot(plane.n, n)));
    own_count = candidate_count;
    if (tips && own_count < 4u) addLevelFaces(tilt);
    bool grazes = (found.info.x & uint(AXIS_GRAZES)) != 0u; // what is beside the face does not touch it
    if (!grazes && (is_swept || found.axis.w <= 0.0)) addLowest(found.axis.w);
}

Touch touchAt(uint candidate) {
    vec4 at = candidate_at[min(candidate, CANDIDATES - 1u)];
    vec3 incident = outOfPlane(at.xyz), under = outOfPlane(vec3(at.xy, 0.0));
    uint name = floatBitsToUint(at.w) | facing.incident_face << 14 | facing.reference_face << 20 | (facing.a_leads ? 0u : 1u << 26);
    return facing.a_leads ? Touch(under, incident, name) : Touch(incident, under, name);
}

const float kSquareEnough = 0.9; // cosine

// How squarely the faces of the two edges face the other hull: A's two, then B's.
vec4 squaresOf(uvec4 faces) {
    vec4 squares = vec4(0.0);
    for (uint k = 0u; k < ROLLED(4); k++) {
        float square = dot(normalOf(k < 2u, faces[k]), k < 2u ? found.axis.xyz : -found.axis.xyz);
        squares = withComponent(squares, k, square);
    }
    return squares;
}

// Of either edge the face that faces the other hull more squarely. Whether the two may give the points.
bool edgesFace(uvec4 faces) {
    vec4 squares = squaresOf(faces);
    bvec2 left = greaterThanEqual(squares.xz, squares.yw);
    vec2 square = mix(squares.yw, squares.xz, left);
    uvec2 face = mix(faces.yw, faces.xz, left);
    bool a_leads = square.x >= square.y;
    facing = Facing(a_leads, a_leads ? face.x : face.y, a_leads ? face.y : face.x);
    return max(square.x, square.y) >= kSquareEnough && min(square.x, square.y) > 0.0;
}

struct Ends {
    vec3 of_a[2], of_b[2];
};

Ends endsOf(uvec4 vertices) {
    vec3 ends[4];
    for (uint k = 0u; k < ROLLED(4); k++) {
        vec3 end = shiftedCorner(k < 2u, vertices[k]);
        for (uint j = 0u; j < 4u; j++) ends[j] = j == k ? end : ends[j];
    }
    return Ends(vec3[2](ends[0], ends[1]), vec3[2](ends[2], ends[3]));
}

// `by_edges`: the axis is one between edges, whose ends are these.
void touchFaces(bool by_edges, Ends ends) {
    spanPlane(facing.a_leads ? found.axis.xyz : -found.axis.xyz);
    if (by_edges) tiltPlane(normalOf(facing.a_leads, facing.reference_face), facing.a_leads ? ends.of_a[0] : ends.of_b[0]);
    else plane.height.z = found.shift.w;
    closePlane();
    gatherCandidates();
    picked = chosen();
    touch_count = uint(dot(vec4(notEqual(picked, uvec4(NO_INDEX))), vec4(1.0)));
}

float closingAt(vec3 p) { return dot(closingAlong(pair, found.axis.xyz, found.shift.xyz), vec4(p, 1.0)); }

// Hulls that are apart further than the margin at the ends of these edges do not touch.
Touch touchEdges(Ends ends) {
    vec3 p = ends.of_a[0], q = ends.of_b[0], d = ends.of_a[1] - p, e = ends.of_b[1] - q, w = p - q;
    float dd = dot(d, d), de = dot(d, e), ee = dot(e, e), dw = dot(d, w), ew = dot(e, w);
    float denominator = max(dd * ee - de * de, 1e-37);
    float s = clamp((de * ew - ee * dw) / denominator, 0.0, 1.0), t = clamp((dd * ew - de * dw) / denominator, 0.0, 1.0);
    Touch touch = Touch(p + s * d, q + t * e, 1u << 27 | (found.info.x & 0xffffu));
    bool near = is_swept || found.axis.w <= 0.0 || distance(touch.on_a, touch.on_b) <= pair.margin + max(closingAt(touch.on_a), 0.0);
    touch_count = near ? 1u : 0u;
    return touch;
}

ContactPoint pointOf(Touch touch) {
    vec3 a = touch.on_a + pair.hull[0].center.xyz;
    vec3 b = touch.on_b - found.shift.xyz - pair.place[1] + pair.axes[1] * pair.hull[1].center.xyz;
    float separation = dot(found.axis.xyz, touch.on_b - touch.on_a - found.shift.xyz);
    return ContactPoint(vec4(turned(pair.turn, a), separation), vec4(turned(pair.turn, b), 0.0), uvec4(touch.name, 0u, 0u, 0u));
}

void writePoints(uint k, bool of_edges, Touch edges_touch) {
    for (uint p = 0u; p < ROLLED(MANIFOLD_POINTS); p++) {
        bool there = p < touch_count;
        Touch touch = touchAt(picked[p]);
        if (of_edges) touch = edges_touch;
        ContactPoint point = pointOf(touch);
        manifolds[k].points[p].arm_a = there ? point.arm_a : vec4(0.0);
        manifolds[k].points[p].arm_b = there ? point.arm_b : vec4(0.0);
        manifolds[k].points[p].id = there ? point.id : uvec4(0u);
    }
}

void writeManifold(uint k, bool of_edges, Touch edges_touch) {
    bool touching = touch_count > 0u;
    manifolds[k].pair = pair.ids;
    manifolds[k].normal = touching ? vec4(turned(pair.turn, found.axis.xyz), 0.0) : vec4(vec3(0.0), max(found.axis.w, 0.0));
    manifolds[k].info = uvec4(touch_count, touching ? found.info.x : 0u, 0u, 0u);
    writePoints(k, of_edges, edges_touch);
}

void main() {
    uint k = flatIndex();
    if (k >= min(counts[push.count_at], push.capacity)) return;
    pair = loadPair(pairs[k], push);
    found = unlessHidden(k, axes[k]);
    is_swept = found.shift.xyz != vec3(0.0);
    uint kind = found.info.x >> AXIS_KIND_SHIFT;
    bool by_edges = kind == AXIS_EDGES, by_faces = !by_edges && kind != AXIS_APART;
    facing = Facing(found.info.y == 0u, min(found.info.z, HULL_FACES - 1u), min(found.info.w, HULL_FACES - 1u));
    Ends ends;
    if (by_edges) {
        uvec4 a = hull_edges[pair.hull[0].first.w + ((found.info.x >> 8) & 0xffu)];
        uvec4 b = hull_edges[pair.hull[1].first.w + (found.info.x & 0xffu)];
        ends = endsOf(uvec4(a.xy, b.xy));
        by_faces = edgesFace(uvec4(a.zw, b.zw));
    }
    if (by_faces) touchFaces(by_edges, ends);
    Touch edges_touch = Touch(vec3(0.0), vec3(0.0), 0u);
    bool of_edges = by_edges && touch_count == 0u;
    if (of_edges) edges_touch = touchEdges(ends);
    writeManifold(k, of_edges, edges_touch);
}
