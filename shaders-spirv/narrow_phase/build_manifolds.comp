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
#include "shared/body.h"
#include "shared/contact.h"
#include "shared/hull.h"
#include "shared/narrow_phase.h"

FLAT_KERNEL;
READS(0, uint, pair_count);
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

Touch touches[MANIFOLD_POINTS];
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

// Wants the plane set.
void gatherCandidates(bool a_leads, uint reference_face, uint incident_face) {
    slack = kSlackShare * pair.smaller;
    reference_count = loadReference(a_leads, reference_face);
    incident_count = loadIncident(!a_leads, incident_face);
    vec3 n = normalOf(!a_leads, incident_face);
    candidate_count = 0u;
    addIncidentEdges();
    addReferenceCorners(vec3(dot(plane.u, n), dot(plane.v, n), dot(plane.n, n)));
    if (is_swept || found.axis.w <= 0.0) addLowest(found.axis.w);
}

void touchChosen(bool a_leads, uint reference_face, uint incident_face) {
    uvec4 picked = chosen();
    for (uint k = 0u; k < MANIFOLD_POINTS; k++) {
        if (picked[k] == NO_INDEX) break;
        vec4 at = candidate_at[picked[k]];
        vec3 incident = outOfPlane(at.xyz), under = outOfPlane(vec3(at.xy, 0.0));
        uint name = floatBitsToUint(at.w) | incident_face << 14 | reference_face << 20 | (a_leads ? 0u : 1u << 26);
        touches[k] = a_leads ? Touch(under, incident, name) : Touch(incident, under, name);
        touch_count++;
    }
}

void touchFaces() {
    bool a_leads = found.info.y == 0u;
    uint reference_face = min(found.info.z, HULL_FACES - 1u), incident_face = min(found.info.w, HULL_FACES - 1u);
    spanPlane(a_leads ? found.axis.xyz : -found.axis.xyz);
    plane.height.z = found.shift.w;
    gatherCandidates(a_leads, reference_face, incident_face);
    touchChosen(a_leads, reference_face, incident_face);
}

const float kSquareEnough = 0.9; // cosine

// Of the two faces of an edge the one that faces the other hull more squarely; y: how squarely, as bits.
uvec2 squarerFace(bool of_a, uvec4 edge) {
    vec3 towards = of_a ? found.axis.xyz : -found.axis.xyz;
    float left = dot(normalOf(of_a, edge.z), towards), right = dot(normalOf(of_a, edge.w), towards);
    return left >= right ? uvec2(edge.z, floatBitsToUint(left)) : uvec2(edge.w, floatBitsToUint(right));
}

// Whether the faces of the two edges give the points.
bool touchAlongEdges(uvec4 a, uvec4 b) {
    uvec2 of_a = squarerFace(true, a), of_b = squarerFace(false, b);
    float square_a = uintBitsToFloat(of_a.y), square_b = uintBitsToFloat(of_b.y);
    if (max(square_a, square_b) < kSquareEnough || min(square_a, square_b) <= 0.0) return false;
    bool a_leads = square_a >= square_b;
    uint reference_face = a_leads ? of_a.x : of_b.x, incident_face = a_leads ? of_b.x : of_a.x;
    spanPlane(a_leads ? found.axis.xyz : -found.axis.xyz);
    tiltPlane(normalOf(a_leads, reference_face), shiftedCorner(a_leads, a_leads ? a.x : b.x));
    gatherCandidates(a_leads, reference_face, incident_face);
    touchChosen(a_leads, reference_face, incident_face);
    return touch_count > 0u;
}

// Hulls that are apart further than the margin at the ends of these edges do not touch.
void touchEdges() {
    uvec4 a = hull_edges[pair.hull[0].first.w + ((found.info.x >> 8) & 0xffu)];
    uvec4 b = hull_edges[pair.hull[1].first.w + (found.info.x & 0xffu)];
    if (touchAlongEdges(a, b)) return;
    vec3 p = shiftedCorner(true, a.x), q = shiftedCorner(false, b.x);
    vec3 d = shiftedCorner(true, a.y) - p, e = shiftedCorner(false, b.y) - q, w = p - q;
    float dd = dot(d, d), de = dot(d, e), ee = dot(e, e), dw = dot(d, w), ew = dot(e, w);
    float denominator = max(dd * ee - de * de, 1e-37);
    float s = clamp((de * ew - ee * dw) / denominator, 0.0, 1.0), t = clamp((dd * ew - de * dw) / denominator, 0.0, 1.0);
    Touch touch = Touch(p + s * d, q + t * e, 1u << 27 | (found.info.x & 0xffffu));
    bool near = is_swept || found.axis.w <= 0.0 || distance(touch.on_a, touch.on_b) <= pair.margin;
    touches[0] = touch;
    touch_count = near ? 1u : 0u;
}

ContactPoint pointOf(Touch touch) {
    vec3 a = touch.on_a + pair.hull[0].center.xyz;
    vec3 b = touch.on_b - found.shift.xyz - pair.place[1] + pair.axes[1] * pair.hull[1].center.xyz;
    float separation = dot(found.axis.xyz, touch.on_b - touch.on_a - found.shift.xyz);
    return ContactPoint(vec4(turned(pair.turn, a), separation), vec4(turned(pair.turn, b), 0.0), uvec4(touch.name, 0u, 0u, 0u));
}

void writeManifold(uint k) {
    bool touching = touch_count > 0u;
    manifolds[k].pair = pair.ids;
    manifolds[k].normal = touching ? vec4(turned(pair.turn, found.axis.xyz), 0.0) : vec4(vec3(0.0), max(found.axis.w, 0.0));
    manifolds[k].info = uvec4(touch_count, touching ? found.info.x : 0u, 0u, 0u);
    for (uint p = 0u; p < MANIFOLD_POINTS; p++) {
        bool there = p < touch_count;
        ContactPoint point = pointOf(touches[p]);
        manifolds[k].points[p].arm_a = there ? point.arm_a : vec4(0.0);
        manifolds[k].points[p].arm_b = there ? point.arm_b : vec4(0.0);
        manifolds[k].points[p].id = there ? point.id : uvec4(0u);
    }
}

void main() {
    uint k = flatIndex();
    if (k >= min(pair_count[0], push.capacity)) return;
    pair = loadPair(pairs[k], push);
    found = axes[k];
    is_swept = found.shift.xyz != vec3(0.0);
    uint kind = found.info.x >> AXIS_KIND_SHIFT;
    if (kind == AXIS_EDGES) touchEdges();
    else if (kind != AXIS_APART) touchFaces();
    writeManifold(k);
}
