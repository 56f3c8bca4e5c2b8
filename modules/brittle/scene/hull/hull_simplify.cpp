#include "modules/brittle/scene/hull/hull_simplify.h"

#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>

namespace brittle {
namespace {

struct Plane {
    Double3 normal = {0, 0, 0};
    double height = 0;
};

double support(const ConvexHull& hull, const Double3& normal) {
    double height = -1e300;
    for (const Double3& v : hull.vertices)
        height = std::max(height, dot(normal, v));
    return height;
}

// Along axes, edges and corners of a cube.
std::vector<Plane> boxPlanes(const ConvexHull& hull) {
    std::vector<Plane> planes;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                if (x == 0 && y == 0 && z == 0) continue;
                const Double3 normal = normalized(Double3{double(x), double(y), double(z)}, {0, 0, 1});
                planes.push_back({normal, support(hull, normal)});
            }
    return planes;
}

// Corners of the solid behind all planes, by duality about a place inside: the hull of the planes' poles has a face for each.
engine::Result<std::vector<Double3>> cornersOf(const std::vector<Plane>& planes, const Double3& inside) {
    std::vector<Double3> poles;
    poles.reserve(planes.size());
    for (const Plane& plane : planes)
        poles.push_back(1 / (plane.height - dot(plane.normal, inside)) * plane.normal);
    const auto dual = fullHullOfPoints(poles);
    if (!dual) return dual.error();
    std::vector<Double3> corners;
    for (const ConvexHull::Face& face : dual->hull.faces)
        corners.push_back(inside + 1 / face.height * face.normal);
    return corners;
}

struct Excess {
    double distance = 0;
    const ConvexHull::Face* face = nullptr;
};

Excess furthestBeyond(const ConvexHull& hull, const std::vector<Double3>& corners) {
    Excess worst;
    for (const ConvexHull::Face& face : hull.faces) {
        double beyond = 0;
        for (const Double3& p : corners)
            beyond = std::max(beyond, dot(face.normal, p) - face.height);
        if (beyond > worst.distance) worst = {beyond, &face};
    }
    return worst;
}

} // namespace

engine::Result<SimpleHull> simplify(const ConvexHull& hull) {
    const Double3 inside = measure(hull).center;
    std::vector<Plane> planes = boxPlanes(hull);
    SimpleHull best;
    for (;;) {
        const auto corners = cornersOf(planes, inside);
        if (!corners) return corners.error();
        auto simple = fullHullOfPoints(*corners);
        if (!simple) return simple.error();
        const Excess worst = furthestBeyond(hull, simple->hull.vertices);
        best = {std::move(simple->hull), worst.distance};
        if (planes.size() == kMaxHullFaces || worst.face == nullptr) break;
        planes.push_back({worst.face->normal, worst.face->height});
    }
    if (best.hull.faces.size() > kMaxHullFaces || best.hull.vertices.size() > kMaxHullVertices)
        return engine::Error{engine::ErrorCode::Internal, "the hull has too many faces and could not be simplified"};
    return best;
}

} // namespace brittle
