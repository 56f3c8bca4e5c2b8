// Faces that a small body may come to lie on before the step ends.
//
// A chip has faces that are nearly level with the one that it touches the ground with. A small one tips from face to face within one
// step. Contacts with one face alone would let it tip into the ground, the next step would push it out, and it would never rest.
// So the face below its center of mass takes the place of the one that touches, if the body can tip so far. If that face is a
// triangle, the fourth point is a corner of another such face.
//
// This holds on what bodies lie on: what is fixed, or much larger. Large bodies hardly tip in a step, and the next one finds them.
//
// Wants lib/contact_candidates.glsl, `facing`, `push`, `faceOf`, `normalOf` and `shiftedCorner`.
#ifndef LEVEL_FACES_GLSL
#define LEVEL_FACES_GLSL

const float kLeastTilt = 0.02, kMostTilt = 0.45; // rad
const float kMuchLarger = 4.0;                   // of radii

float radiusOfHull(bool of_a) { return of_a ? pair.hull[0].center.w : pair.hull[1].center.w; }

uint facesOf(bool of_a) { return of_a ? pair.hull[0].count.y : pair.hull[1].count.y; }

// rad. A body that falls freely about an edge tips by so much in a step.
float tiltInStep() {
    return min(0.5 * length(push.gravity.xyz) * push.step * push.step / radiusOfHull(!facing.a_leads), kMostTilt);
}

bool liesOnGround() {
    bool is_fixed = bodies[facing.a_leads ? pair.ids.z : pair.ids.w].offset.w == 0.0;
    return is_fixed || radiusOfHull(facing.a_leads) >= kMuchLarger * radiusOfHull(!facing.a_leads);
}

// How far a point lies beyond the side of the reference polygon that it passes furthest.
float outsideReference(vec2 at) {
    float outside = -kFar;
    vec2 corner = reference_at[reference_count - 1u];
    for (uint j = 0u; j < reference_count; j++) {
        vec2 next = reference_at[j];
        outside = max(outside, dot(outwardOf(corner, next), at - corner));
        corner = next;
    }
    return outside;
}

// How far a point lies beyond the sides of a face of the incident hull. kFar if a corner of it is higher than the margin.
float outsideFace(bool of_a, uint face, vec2 at) {
    uvec2 loop = faceOf(of_a, face).loop.xy;
    uint count = min(loop.y, FACE_CORNERS);
    float outside = -kFar;
    vec3 corner = inPlane(shiftedCorner(of_a, hull_corners[loop.x + count - 1u]));
    for (uint c = 0u; c < count; c++) {
        vec3 next = inPlane(shiftedCorner(of_a, hull_corners[loop.x + c]));
        outside = max(outside, next.z > pair.margin ? kFar : dot(outwardOf(next.xy, corner.xy), at - corner.xy));
        corner = next;
    }
    return outside;
}

// The face below the center of mass, of those that are level with the incident one. The incident face itself if no such face exists.
uint faceBelowCenter(float tilt) {
    bool of_a = !facing.a_leads;
    vec2 center = inPlane(centerOfMass(pair, of_a ? 0u : 1u) + (of_a ? vec3(0.0) : found.shift.xyz)).xy;
    uint best = facing.incident_face;
    vec3 n = normalOf(of_a, best);
    if (outsideFace(of_a, best, center) <= 0.0) return best;
    float least = 0.0;
    for (uint f = 0u; f < facesOf(of_a); f++) {
        if (distance(n, normalOf(of_a, f)) > tilt) continue;
        float outside = outsideFace(of_a, f, center);
        best = outside < least ? f : best;
        least = min(outside, least);
    }
    return best;
}

bool isCandidate(uint line, uint other) {
    for (uint k = 0u; k < candidate_count; k++)
        if (floatBitsToUint(candidate_at[k].w) == (line << 7 | other)) return true;
    return false;
}

// Its name is the vertex, twice: no other candidate lies where a line meets itself.
void addVertex(bool of_a, uint vertex) {
    vec3 at = inPlane(shiftedCorner(of_a, vertex));
    if (outsideIncident(at.xy) <= slack || outsideReference(at.xy) > slack || isCandidate(vertex, vertex)) return;
    addCandidate(at, vertex, vertex);
}

void addLevelFaces(float tilt) {
    bool of_a = !facing.a_leads;
    vec3 n = normalOf(of_a, facing.incident_face);
    for (uint f = 0u; f < facesOf(of_a); f++) {
        if (f == facing.incident_face || distance(n, normalOf(of_a, f)) > tilt) continue;
        uvec2 loop = faceOf(of_a, f).loop.xy;
        for (uint c = 0u; c < min(loop.y, FACE_CORNERS); c++) addVertex(of_a, hull_corners[loop.x + c]);
    }
}

#endif
