// The place of a hull that is nearest to a point, both in the frame of their body; the point itself where it lies within. Wants
// `hulls`, `hull_vertices`, `hull_faces` and `hull_corners` declared.
#include "shared/hull.h"

vec3 cornerOf(HullRecord hull, HullFace face, uint k) { return hull_vertices[hull.first.x + hull_corners[face.loop.x + k]].xyz; }

vec3 nearestOnEdge(vec3 a, vec3 b, vec3 p) {
    vec3 along = b - a;
    float size = dot(along, along);
    return a + (size > 0.0 ? clamp(dot(p - a, along) / size, 0.0, 1.0) : 0.0) * along;
}

// The foot of the point, if no side has it on its right; else a place on a side.
vec3 nearestOnFace(HullRecord hull, HullFace face, vec3 p, float height) {
    vec3 foot = p - height * face.plane.xyz, best = foot;
    float least = 3e38;
    bool within = true;
    uint corners = min(face.loop.y, uint(HULL_EDGES));
    for (uint k = 0u; k < corners; k++) {
        vec3 a = cornerOf(hull, face, k), b = cornerOf(hull, face, k + 1u < corners ? k + 1u : 0u), q = nearestOnEdge(a, b, p);
        within = within && dot(cross(b - a, foot - a), face.plane.xyz) >= 0.0;
        float square = dot(q - p, q - p);
        if (square < least) {
            least = square;
            best = q;
        }
    }
    return within ? foot : best;
}

vec3 nearestOnHull(HullRecord hull, vec3 p) {
    vec3 best = p;
    float least = 3e38;
    bool inside = true;
    for (uint f = 0u; f < min(hull.count.y, uint(HULL_FACES)); f++) {
        HullFace face = hull_faces[hull.first.y + f];
        float height = dot(face.plane.xyz, p) - face.plane.w;
        if (height <= 0.0) continue;
        inside = false;
        vec3 q = nearestOnFace(hull, face, p, height);
        float square = dot(q - p, q - p);
        if (square < least) {
            least = square;
            best = q;
        }
    }
    return inside ? p : best;
}

// From a body's center of mass to where a strike is, in the body's own frame.
vec3 strikeIn(BodyState body, Strike strike) {
    vec3 way = vec3(strike.sector.xyz - body.sector.xyz) * float(SECTOR_EDGE) + (strike.offset.xyz - body.offset.xyz);
    return turned(turnBack(body.turn), way);
}
