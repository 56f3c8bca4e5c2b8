#include "modules/brittle/dynamics/body_surface.h"

#include <Eigen/Geometry>

#include <cstring>

namespace brittle {
namespace {

FragmentVertex vertexAt(const Double3& place, const Double3& normal, const Float2& uv = {0, 0}) {
    const Float3 p = toFloat(place), n = toFloat(normal);
    return {{p[0], p[1], p[2]}, {n[0], n[1], n[2]}, {uv[0], uv[1]}};
}

Double3 normalOf(const FragmentVertex& v) { return toDouble({v.normal[0], v.normal[1], v.normal[2]}); }

FragmentVertex rotated(const FragmentVertex& v, const Eigen::Quaterniond& turn) {
    const Double3 p = positionOf(v), n = normalOf(v);
    const Eigen::Vector3d place = turn * Eigen::Vector3d(p[0], p[1], p[2]), normal = turn * Eigen::Vector3d(n[0], n[1], n[2]);
    return vertexAt({place.x(), place.y(), place.z()}, {normal.x(), normal.y(), normal.z()}, {v.uv[0], v.uv[1]});
}

void turnIntoAxes(SurfaceMesh& surface, const Turn& axes) {
    if (axes == Turn{0, 0, 0, 1}) return;
    const Eigen::Quaterniond back = Eigen::Quaterniond(axes[3], axes[0], axes[1], axes[2]).conjugate();
    for (FragmentVertex& v : surface.vertices)
        v = rotated(v, back);
}

template <class T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool sameSurface(const SurfaceMesh& a, const SurfaceMesh& b) {
    return a.outer_index_count == b.outer_index_count && sameBytes(a.vertices, b.vertices) && sameBytes(a.indices, b.indices);
}

uint64_t hashOf(const SurfaceMesh& surface) {
    const auto text = [](const auto& values) {
        return std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]);
    };
    return std::hash<std::string_view>()(text(surface.vertices)) * 31 + std::hash<std::string_view>()(text(surface.indices));
}

void closeOutside(SurfaceMesh& surface) { surface.outer_index_count = static_cast<uint32_t>(surface.indices.size()); }

} // namespace

SurfaceMesh surfaceOf(const ConvexHull& hull, const Double3& center) {
    SurfaceMesh surface;
    for (const ConvexHull::Face& face : hull.faces) {
        const auto first = static_cast<uint32_t>(surface.vertices.size());
        for (uint32_t k = 0; k < face.corner_count; ++k)
            surface.vertices.push_back(vertexAt(hull.vertices[hull.corners[face.first_corner + k]] - center, face.normal));
        for (uint32_t k = 2; k < face.corner_count; ++k)
            surface.indices.insert(surface.indices.end(), {first, first + k - 1, first + k});
    }
    closeOutside(surface);
    return surface;
}

SurfaceMesh surfaceOf(const FragmentSet& set, const Fragment& fragment, const Double3& center) {
    SurfaceMesh surface;
    for (uint32_t k = 0; k < fragment.vertex_count; ++k) {
        const FragmentVertex& v = set.vertices[fragment.first_vertex + k];
        surface.vertices.push_back(vertexAt(positionOf(v) - center, normalOf(v), {v.uv[0], v.uv[1]}));
    }
    const auto first = set.indices.begin() + fragment.first_index;
    surface.indices.assign(first, first + fragment.outer_index_count + fragment.inner_index_count);
    surface.outer_index_count = fragment.outer_index_count - fragment.earlier_index_count;
    return surface;
}

SurfaceMesh surfaceOf(const Mesh& mesh, const Double3& center) {
    SurfaceMesh surface;
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            surface.indices.push_back(static_cast<uint32_t>(surface.vertices.size()));
            surface.vertices.push_back(vertexAt(toDouble(mesh.positions[mesh.triangles[t][k]]) - center,
                                                toDouble(mesh.corner_normals[3 * t + k]), mesh.corner_uvs[3 * t + k]));
        }
    closeOutside(surface);
    return surface;
}

SurfaceMesh surfaceOf(const ImportedMesh& model) {
    SurfaceMesh surface;
    for (size_t t = 0; t < model.triangles.size(); ++t) {
        const auto corner = [&](size_t k) { return model.positions[model.triangles[t][k]]; };
        const Double3 own = normalized(cross(corner(1) - corner(0), corner(2) - corner(0)), {0, 1, 0});
        for (size_t k = 0; k < 3; ++k) {
            surface.indices.push_back(static_cast<uint32_t>(surface.vertices.size()));
            surface.vertices.push_back(
                vertexAt(corner(k), normalized(toDouble(model.corner_normals[3 * t + k]), own), model.corner_uvs[3 * t + k]));
        }
    }
    closeOutside(surface);
    return surface;
}

SurfaceMesh squareSurface(double edge) {
    const double half = edge / 2;
    SurfaceMesh surface;
    for (const auto& [x, z] : {std::array{-half, -half}, {-half, half}, {half, half}, {half, -half}})
        surface.vertices.push_back(vertexAt({x, 0, z}, {0, 1, 0}));
    surface.indices = {0, 1, 2, 0, 2, 3};
    closeOutside(surface);
    return surface;
}

void SurfaceCollector::add(const BodyDefinition& body, SurfaceMesh surface, bool is_plane) {
    turnIntoAxes(surface, axesOf(body));
    surfaces_.bodies.push_back({indexOf(std::move(surface)), body.name, body.mass > 0, is_plane, {}, body.material});
}

uint32_t SurfaceCollector::indexOf(SurfaceMesh surface) {
    const uint64_t hash = hashOf(surface);
    const auto [first, last] = by_hash_.equal_range(hash);
    for (auto found = first; found != last; ++found)
        if (sameSurface(surfaces_.meshes[found->second], surface)) return found->second;
    const auto index = static_cast<uint32_t>(surfaces_.meshes.size());
    by_hash_.emplace(hash, index);
    surfaces_.meshes.push_back(std::move(surface));
    return index;
}

} // namespace brittle
