// The point nearest to the origin of a simplex of up to four corners, and the corners that it lies between: all parts of the
// simplex are asked, corners, edges, faces; of those whose nearest point lies inside of them the nearest counts.
struct Nearest {
    vec3 point;
    uint used;     // a bit a corner
    bool encloses; // the origin lies within a simplex of four
};

bool liesAbove(vec3 a, vec3 b, vec3 c, vec3 p) { return dot(cross(b - a, c - a), p - a) > 0.0; }

bool enclosesOrigin(vec3 s[4]) {
    bool inside = true;
    for (uint k = 0u; k < 4u; k++) {
        vec3 a = s[(k + 1u) & 3u], b = s[(k + 2u) & 3u], c = s[(k + 3u) & 3u];
        inside = inside && liesAbove(a, b, c, s[k]) == liesAbove(a, b, c, vec3(0.0)) && dot(cross(b - a, c - a), s[k] - a) != 0.0;
    }
    return inside;
}

void take(inout Nearest best, vec3 point, uint used, bool lies_inside) {
    if (lies_inside && dot(point, point) < dot(best.point, best.point)) {
        best.point = point;
        best.used = used;
    }
}

void takeEdge(inout Nearest best, vec3 a, vec3 b, uint used) {
    vec3 along = b - a;
    float size = dot(along, along), t = size > 0.0 ? -dot(a, along) / size : -1.0;
    take(best, a + t * along, used, t > 0.0 && t < 1.0);
}

void takeFace(inout Nearest best, vec3 a, vec3 b, vec3 c, uint used) {
    vec3 n = cross(b - a, c - a);
    float size = dot(n, n), u = dot(n, cross(b, c)), v = dot(n, cross(c, a)), w = dot(n, cross(a, b));
    take(best, n * (size > 0.0 ? dot(a, n) / size : 0.0), used, size > 0.0 && u > 0.0 && v > 0.0 && w > 0.0);
}

Nearest nearestOf(vec3 s[4], uint count) {
    Nearest best = Nearest(vec3(1e18), 0u, count == 4u && enclosesOrigin(s));
    for (uint a = 0u; a < count; a++) take(best, s[a], 1u << a, true);
    for (uint a = 0u; a < count; a++) {
        for (uint b = a + 1u; b < count; b++) takeEdge(best, s[a], s[b], 1u << a | 1u << b);
    }
    for (uint k = 0u; k < 4u; k++) {
        uint a = k == 0u ? 1u : 0u, b = k <= 1u ? 2u : 1u, c = k <= 2u ? 3u : 2u;
        if (c < count) takeFace(best, s[a], s[b], s[c], 1u << a | 1u << b | 1u << c);
    }
    return best;
}
