#include "modules/brittle/mesh/normals.h"

#include "modules/brittle/mesh/topology.h"
#include "modules/brittle/mesh/triangle_shape.h"

#include <algorithm>
#include <numeric>

namespace brittle {
namespace {

constexpr double kCreaseCosine = 0.76604444; // 40 degrees

// Zero where a triangle has no area.
Double3 faceNormal(const Corners& p) { return normalized(cross(p[1] - p[0], p[2] - p[0]), {0, 0, 0}); }

double angleAt(const Corners& p, size_t k) {
    const Double3 a = p[(k + 1) % 3] - p[k], b = p[(k + 2) % 3] - p[k];
    return std::atan2(length(cross(a, b)), dot(a, b));
}

// Sets of corners that share a normal: union-find over the corners, joined across smooth edges.
class SmoothGroups {
public:
    SmoothGroups(const Mesh& mesh, const MeshTopology& topology, const std::vector<Double3>& face_normals) {
        parent_.resize(mesh.corner_normals.size());
        std::iota(parent_.begin(), parent_.end(), 0u);
        for (uint32_t h = 0; h < parent_.size(); ++h) {
            const uint32_t mate = topology.half_edge_mates[h];
            if (mate == kNoMate || mate < h) continue;
            const Double3 &a = face_normals[h / 3], &b = face_normals[mate / 3];
            const bool has_no_normal = dot(a, a) == 0 || dot(b, b) == 0; // an area of nothing does not make a crease
            if (!has_no_normal && dot(a, b) < kCreaseCosine) continue;
            join(h, next(mate)); // a half-edge and the one after its mate start at the same vertex
            join(next(h), mate);
        }
    }
    uint32_t root(uint32_t corner) {
        while (parent_[corner] != corner)
            corner = parent_[corner] = parent_[parent_[corner]];
        return corner;
    }

private:
    static uint32_t next(uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
    void join(uint32_t a, uint32_t b) {
        const uint32_t ra = root(a), rb = root(b);
        parent_[std::max(ra, rb)] = std::min(ra, rb);
    }
    std::vector<uint32_t> parent_;
};

bool isGiven(const Float3& normal) {
    const double squared = dot(toDouble(normal), toDouble(normal));
    return std::isfinite(squared) && squared > 0;
}

} // namespace

void completeNormals(Mesh& mesh, const MeshTopology& topology) {
    const size_t corner_count = 3 * mesh.triangles.size();
    mesh.corner_normals.resize(corner_count, {0, 0, 0});
    for (Float3& normal : mesh.corner_normals)
        normal = isGiven(normal) ? toFloat(normalized(toDouble(normal), {0, 0, 0})) : Float3{0, 0, 0};
    if (std::all_of(mesh.corner_normals.begin(), mesh.corner_normals.end(), isGiven)) return;

    std::vector<Double3> face_normals;
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        face_normals.push_back(faceNormal(cornersOf(mesh, t)));
    SmoothGroups groups(mesh, topology, face_normals);
    std::vector<Double3> sums(corner_count, {0, 0, 0});
    for (uint32_t corner = 0; corner < corner_count; ++corner)
        sums[groups.root(corner)] += angleAt(cornersOf(mesh, corner / 3), corner % 3) * face_normals[corner / 3];
    for (uint32_t corner = 0; corner < corner_count; ++corner) {
        if (isGiven(mesh.corner_normals[corner])) continue;
        const Double3 upright = normalized(face_normals[corner / 3], {0, 0, 1});
        mesh.corner_normals[corner] = toFloat(normalized(sums[groups.root(corner)], upright));
    }
}

} // namespace brittle
