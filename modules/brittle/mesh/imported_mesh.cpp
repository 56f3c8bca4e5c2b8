#include "modules/brittle/mesh/imported_mesh.h"

#include "modules/brittle/mesh/polygon.h"
#include "modules/brittle/mesh/vector_math.h"

namespace brittle {
namespace {

// Along the diagonal at which the halves bend less.
std::vector<Index3> cutFoldedQuad(const std::vector<Double3>& p) {
    const std::vector<Index3> cuts[] = {{{0, 1, 2}, {0, 2, 3}}, {{1, 2, 3}, {1, 3, 0}}};
    const auto normal = [&](const Index3& t) { return normalized(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]), {0, 0, 0}); };
    const auto agreement = [&](const std::vector<Index3>& cut) { return dot(normal(cut[0]), normal(cut[1])); };
    return agreement(cuts[1]) > agreement(cuts[0]) ? cuts[1] : cuts[0];
}

} // namespace

const char* MeshBuilder::addPolygon(std::span<const PolygonCorner> corners) {
    if (corners.size() == 1 || corners.size() == 2) ++small_faces_;
    corners_.clear();
    for (const PolygonCorner& corner : corners)
        if (corners_.empty() || corners_.back().position != corner.position) corners_.push_back(corner);
    while (corners_.size() > 1 && corners_.back().position == corners_.front().position)
        corners_.pop_back();
    if (corners_.size() < 3) return nullptr;
    if (corners_.size() == 3) {
        addTriangle(corners_[0], corners_[1], corners_[2]);
        return nullptr;
    }
    if (corners_.size() > kMaxPolygonCorners) return "a polygon has more than 10,000 corners; triangulate it before export";
    outline_.clear();
    for (const PolygonCorner& corner : corners_)
        outline_.push_back(mesh_.positions[corner.position]);
    std::vector<Index3> triangles = triangulatePolygon(outline_);
    if (triangles.empty() && corners_.size() == 4) {
        triangles = cutFoldedQuad(outline_);
        ++folded_quads_;
    }
    if (triangles.empty()) return "a polygon crosses itself or winds too much; triangulate it before export";
    for (const Index3& t : triangles)
        addTriangle(corners_[t[0]], corners_[t[1]], corners_[t[2]]);
    return nullptr;
}

ImportedMesh MeshBuilder::take() {
    if (folded_quads_ > 0)
        mesh_.notes.push_back("quads that seem to cross themselves are cut along a diagonal: " + std::to_string(folded_quads_));
    if (small_faces_ > 0)
        mesh_.notes.push_back("points, lines and faces of one or two corners are left out: " + std::to_string(small_faces_));
    return std::move(mesh_);
}

void MeshBuilder::addTriangle(const PolygonCorner& a, const PolygonCorner& b, const PolygonCorner& c) {
    mesh_.triangles.push_back({a.position, b.position, c.position});
    for (const PolygonCorner* corner : {&a, &b, &c}) {
        mesh_.corner_normals.push_back(corner->normal);
        mesh_.corner_uvs.push_back(corner->uv);
    }
}

} // namespace brittle
