// Where a face of one hull lies over a face of another: up to four points.
//
// Both faces are seen along the axis, which is the normal of the reference face or near it. Each edge of the incident face is cut by all sides of the reference
// face at once, which gives the corners of the clipped polygon that lie on it; those of the reference face that lie within the
// incident one are the others. That is the polygon of Sutherland and Hodgman (1974), found without passing it from side to
// side, so that every corner is named by the two lines that it lies on: names stay while the same features touch.
#ifndef CONTACT_CANDIDATES_GLSL
#define CONTACT_CANDIDATES_GLSL

#define FACE_CORNERS HULL_FACES
#define CANDIDATES (2u * FACE_CORNERS)

struct Plane2 {
    vec3 u, v, n; // n: the axis, out of the reference hull
    vec3 height;  // of the reference face along n: how fast it grows along u and v, and where both are 0
};

Plane2 plane;
vec2 reference_at[FACE_CORNERS];
vec3 incident_at[FACE_CORNERS]; // z: above the reference face
vec4 candidate_at[CANDIDATES];  // w: name, as bits
uint reference_count, incident_count, candidate_count;
uint own_count; // candidates of the incident face; what follows lies on faces that are level with it
float slack; // by which a point may lie beside the reference face
vec3 closing; // how far the faces come closer where they turn: how it grows along u and v, and where both are 0

void spanPlane(vec3 n) {
    vec3 size = abs(n);
    vec3 axis = size.x <= size.y && size.x <= size.z ? vec3(1, 0, 0) : size.y <= size.z ? vec3(0, 1, 0) : vec3(0, 0, 1);
    vec3 u = normalize(cross(axis, n));
    plane = Plane2(u, cross(n, u), n, vec3(0.0));
}

// A plane through `from`, which faces n squarely enough.
void tiltPlane(vec3 normal, vec3 from) {
    vec2 slope = -vec2(dot(normal, plane.u), dot(normal, plane.v)) / dot(normal, plane.n);
    plane.height = vec3(slope, dot(plane.n, from) - dot(slope, vec2(dot(plane.u, from), dot(plane.v, from))));
}

// The same all along n, which is the axis: turns about it change no heights.
void closePlane() {
    vec4 along = closingAlong(pair, found.axis.xyz, found.shift.xyz);
    closing = vec3(dot(along.xyz, plane.u), dot(along.xyz, plane.v), along.w);
}

float heightAt(vec2 at) { return dot(plane.height.xy, at) + plane.height.z; }

vec3 inPlane(vec3 p) {
    vec2 at = vec2(dot(plane.u, p), dot(plane.v, p));
    return vec3(at, dot(plane.n, p) - heightAt(at));
}

vec3 outOfPlane(vec3 p) { return p.x * plane.u + p.y * plane.v + (p.z + heightAt(p.xy)) * plane.n; }

void addAnyway(vec3 at, uint line, uint other) {
    if (candidate_count >= CANDIDATES) return;
    candidate_at[candidate_count] = vec4(at, uintBitsToFloat(line << 7 | other));
    candidate_count++;
}

void addCandidate(vec3 at, uint line, uint other) {
    if (at.z <= pair.margin + max(dot(closing, vec3(at.xy, 1.0)), 0.0)) addAnyway(at, line, other);
}

// Outward, unit, of the side from p to q of a polygon that is counterclockwise; 0 where it has no length.
vec2 outwardOf(vec2 p, vec2 q) {
    vec2 d = q - p;
    float square = dot(d, d);
    return square > 0.0 ? vec2(d.y, -d.x) * inversesqrt(square) : vec2(0.0);
}

// The part of an incident edge that lies over the reference face, as shares of its length, and the sides that end it.
struct Cut {
    float first, last;
    uint first_side, last_side;
};

Cut cutEdge(vec2 p, vec2 q) {
    Cut cut = Cut(0.0, 1.0, NO_INDEX, NO_INDEX);
    vec2 corner = reference_at[reference_count - 1u];
    for (uint j = 0u; j < reference_count; j++) {
        vec2 next = reference_at[j];
        vec2 out_of = outwardOf(corner, next);
        float a = dot(out_of, p - corner) - slack, b = dot(out_of, q - corner) - slack;
        float at = a / (a - b);
        if (a > 0.0 && b > 0.0) cut.last = -1.0;
        if (a > 0.0 && b <= 0.0 && at > cut.first) {
            cut.first = at;
            cut.first_side = j;
        }
        if (a <= 0.0 && b > 0.0 && at < cut.last) {
            cut.last = at;
            cut.last_side = j;
        }
        corner = next;
    }
    return cut;
}

void addIncidentEdges() {
    vec3 p = incident_at[incident_count - 1u];
    uint before = incident_count - 1u;
    for (uint i = 0u; i < incident_count; i++) {
        vec3 q = incident_at[i];
        Cut cut = cutEdge(p.xy, q.xy);
        if (cut.first <= cut.last) {
            // A corner that is not cut off is that of edge i and the one before.
            uint start = cut.first_side == NO_INDEX ? before : FACE_CORNERS + cut.first_side;
            addCandidate(mix(p, q, cut.first), start, i);
            if (cut.last_side != NO_INDEX) addCandidate(mix(p, q, cut.last), i, FACE_CORNERS + cut.last_side);
        }
        before = i;
        p = q;
    }
}

// How far a point lies beyond the side of the incident polygon that it passes furthest. Seen along n that polygon is clockwise.
float outsideIncident(vec2 at) {
    float outside = -kFar;
    vec2 corner = incident_at[incident_count - 1u].xy;
    for (uint i = 0u; i < incident_count; i++) {
        vec2 next = incident_at[i].xy;
        outside = max(outside, dot(outwardOf(next, corner), at - corner));
        corner = next;
    }
    return outside;
}

// `n`: of the incident face, in the plane's axes.
void addReferenceCorners(vec3 n) {
    if (abs(n.z) < 0.01) return;
    uint before = reference_count - 1u;
    for (uint j = 0u; j < reference_count; j++) {
        vec2 at = reference_at[j], way = at - incident_at[0].xy;
        float height = incident_at[0].z - dot(n.xy, way) / n.z - dot(plane.height.xy, way);
        uint next = j + 1u == reference_count ? 0u : j + 1u;
        if (outsideIncident(at) < -slack) addCandidate(vec3(at, height), FACE_CORNERS + next, FACE_CORNERS + j);
    }
}

// The lowest corner of the incident face, where nothing that is left lies about as low: it may lie beside the reference face
// where an axis between edges would have done as well, and a little above the lowest corner of the hull, of faces that all but hold it.
void addLowest(float expected) {
    for (uint k = 0u; k < candidate_count; k++)
        if (candidate_at[k].z <= expected + slack) return;
    uint lowest = 0u;
    float least = incident_at[0].z;
    for (uint i = 1u; i < incident_count; i++) {
        float height = incident_at[i].z;
        lowest = height < least ? i : lowest;
        least = height < least ? height : least;
    }
    addAnyway(incident_at[lowest], lowest, lowest + 1u == incident_count ? 0u : lowest + 1u);
}

#endif
