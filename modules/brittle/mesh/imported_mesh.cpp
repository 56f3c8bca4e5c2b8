#include "modules/brittle/mesh/imported_mesh.h"

#include "modules/brittle/mesh/polygon.h"

namespace brittle {

const char* MeshBuilder::addPolygon(std::span<const PolygonCorner> corners) {
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
    const std::vector<Index3> triangles = triangulatePolygon(outline_);
    if (triangles.empty()) return "a polygon crosses itself or winds too much; triangulate it before export";
    for (const Index3& t : triangles)
        addTriangle(corners_[t[0]], corners_[t[1]], corners_[t[2]]);
    return nullptr;
}

void MeshBuilder::addTriangle(const PolygonCorner& a, const PolygonCorner& b, const PolygonCorner& c) {
    mesh_.triangles.push_back({a.position, b.position, c.position});
    for (const PolygonCorner* corner : {&a, &b, &c}) {
        mesh_.corner_normals.push_back(corner->normal);
        mesh_.corner_uvs.push_back(corner->uv);
    }
}

} // namespace brittle
