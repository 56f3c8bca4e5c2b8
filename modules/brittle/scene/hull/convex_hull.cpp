#include "modules/brittle/scene/hull/convex_hull.h"

#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/hull/hull_points.h"
#include "modules/brittle/scene/hull/hull_simplify.h"
#include "modules/brittle/scene/hull/qhull_faces.h"
#include "modules/brittle/scene/hull/support_tree.h"

#include <algorithm>
#include <map>
#include <utility>

namespace brittle {
namespace {

constexpr uint32_t kNone = 0xffffffff;

// Twice the area, along the normal (Newell). About the first corner, so that distance from the origin costs no digits.
Double3 areaVector(const std::vector<Double3>& points, const std::vector<uint32_t>& loop) {
    Double3 sum = {0, 0, 0};
    for (size_t k = 1; k + 1 < loop.size(); ++k)
        sum += cross(points[loop[k]] - points[loop[0]], points[loop[k + 1]] - points[loop[0]]);
    return sum;
}

// Keeps the points that are corners, in their order, and renames the loops.
std::vector<Double3> takeCorners(const std::vector<Double3>& points, std::vector<PointFace>& faces) {
    std::vector<uint32_t> names(points.size(), kNone);
    for (const PointFace& face : faces)
        for (const uint32_t v : face.loop)
            names[v] = 0;
    std::vector<Double3> corners;
    for (size_t v = 0; v < points.size(); ++v)
        if (names[v] == 0) {
            names[v] = static_cast<uint32_t>(corners.size());
            corners.push_back(points[v]);
        }
    for (PointFace& face : faces)
        for (uint32_t& v : face.loop)
            v = names[v];
    return corners;
}

// Loops begin at their lowest vertex and faces are in order of their loops, so that Qhull's own order decides nothing.
void order(std::vector<PointFace>& faces, const std::vector<Double3>& vertices) {
    for (PointFace& face : faces) {
        const Double3 area = areaVector(vertices, face.loop);
        if (dot(area, face.normal) < 0) std::reverse(face.loop.begin(), face.loop.end());
        std::rotate(face.loop.begin(), std::min_element(face.loop.begin(), face.loop.end()), face.loop.end());
    }
    std::sort(faces.begin(), faces.end(), [](const PointFace& a, const PointFace& b) { return a.loop < b.loop; });
}

void addFace(ConvexHull& hull, const PointFace& from, const SupportTree& vertices) {
    ConvexHull::Face face;
    face.normal = normalized(areaVector(hull.vertices, from.loop), from.normal);
    face.height = vertices.support(face.normal);
    face.first_corner = static_cast<uint32_t>(hull.corners.size());
    face.corner_count = static_cast<uint32_t>(from.loop.size());
    hull.corners.insert(hull.corners.end(), from.loop.begin(), from.loop.end());
    hull.faces.push_back(face);
}

// False where the faces do not close up.
bool linkEdges(ConvexHull& hull) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> left_of;
    for (uint32_t f = 0; f < hull.faces.size(); ++f) {
        const ConvexHull::Face& face = hull.faces[f];
        for (uint32_t k = 0; k < face.corner_count; ++k) {
            const uint32_t from = hull.corners[face.first_corner + k];
            const uint32_t to = hull.corners[face.first_corner + (k + 1) % face.corner_count];
            if (!left_of.try_emplace({from, to}, f).second) return false;
        }
    }
    for (const auto& [edge, face] : left_of) {
        const auto back = left_of.find({edge.second, edge.first});
        if (back == left_of.end()) return false;
        if (edge.first < edge.second) hull.edges.push_back({edge.first, edge.second, face, back->second});
    }
    return hull.vertices.size() + hull.faces.size() == hull.edges.size() + 2;
}

engine::Error notMade(const std::string& why) {
    return {engine::ErrorCode::Internal, "no hull of these points: " + why + "; move them a little"};
}

engine::Result<ConvexHull> assemble(const std::vector<Double3>& points, std::vector<PointFace> faces) {
    for (const PointFace& face : faces)
        if (face.loop.size() < 3) return notMade("a face has no outline");
    ConvexHull hull;
    hull.vertices = takeCorners(points, faces);
    order(faces, hull.vertices);
    const SupportTree vertices(hull.vertices);
    for (const PointFace& face : faces)
        addFace(hull, face, vertices);
    if (!linkEdges(hull)) return notMade("its faces do not close up");
    return hull;
}

// The furthest that a corner lies below its own face's plane.
double depthOfFaces(const ConvexHull& hull) {
    double depth = 0;
    for (const ConvexHull::Face& face : hull.faces)
        for (uint32_t k = 0; k < face.corner_count; ++k)
            depth = std::max(depth, face.height - dot(face.normal, hull.vertices[hull.corners[face.first_corner + k]]));
    return depth;
}

// Neighbors that are flat to the tolerance become one face. Where many in a row are nearly flat, faces may grow less flat than
// is promised, or not close up; then less and less is joined, and in the end nothing but what is flat to rounding.
engine::Result<ConvexHull> hullOfClean(const CleanPoints& clean) {
    engine::Error last;
    for (const double share : {1.0, 0.1, 0.01, 0.0}) {
        auto faces = facesOfHull(clean, share * kHullTolerance);
        auto hull = faces ? assemble(clean.points, std::move(*faces)) : faces.error();
        if (hull && depthOfFaces(*hull) <= kFaceDepth * kHullTolerance * clean.size) return hull;
        last = hull ? notMade("its faces are not flat") : hull.error();
    }
    return last;
}

} // namespace

engine::Result<PointHull> fullHullOfPoints(std::span<const Double3> points) {
    const auto clean = cleanPoints(points);
    if (!clean) return clean.error();
    auto hull = hullOfClean(*clean);
    if (!hull) return hull.error();
    PointHull result;
    result.measures = measure(*hull);
    result.hull = std::move(*hull);
    result.notes.joined = clean->joined;
    result.notes.faces_in = static_cast<uint32_t>(result.hull.faces.size());
    return result;
}

engine::Result<PointHull> hullOfPoints(std::span<const Double3> points) {
    auto full = fullHullOfPoints(points);
    if (!full || (full->hull.faces.size() <= kMaxHullFaces && full->hull.vertices.size() <= kMaxHullVertices)) return full;
    auto simple = simplify(full->hull);
    if (!simple) return simple.error();
    full->hull = std::move(simple->hull);
    full->notes.loosened = simple->loosened;
    return full;
}

// Tetrahedra from the hull's first vertex to every triangle of its faces.
HullMeasures measure(const ConvexHull& hull) {
    HullMeasures sum;
    std::array<Double3, 3> second = {}; // of the places, summed over the volume, about the first vertex
    Double3 moment = {0, 0, 0};
    const Double3& origin = hull.vertices[0];
    for (const ConvexHull::Face& face : hull.faces)
        for (uint32_t k = 1; k + 1 < face.corner_count; ++k) {
            const auto corner = [&](uint32_t i) { return hull.vertices[hull.corners[face.first_corner + i]] - origin; };
            const Double3 a = corner(0), b = corner(k), c = corner(k + 1), s = a + b + c;
            const double volume = dot(a, cross(b, c)) / 6;
            sum.volume += volume;
            moment += volume / 4 * s;
            for (size_t i = 0; i < 3; ++i)
                second[i] += volume / 20 * (a[i] * a + b[i] * b + c[i] * c + s[i] * s);
        }
    const Double3 arm = 1 / sum.volume * moment;
    for (size_t i = 0; i < 3; ++i)
        second[i] = second[i] - sum.volume * arm[i] * arm;
    sum.center = origin + arm;
    sum.inertia = {second[1][1] + second[2][2],
                   second[0][0] + second[2][2],
                   second[0][0] + second[1][1],
                   -second[0][1],
                   -second[0][2],
                   -second[1][2]};
    return sum;
}

} // namespace brittle
