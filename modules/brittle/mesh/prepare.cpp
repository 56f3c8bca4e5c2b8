#include "modules/brittle/mesh/prepare.h"

#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/measures.h"
#include "modules/brittle/mesh/normals.h"
#include "modules/brittle/mesh/topology.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/mesh/welder.h"

#include <algorithm>
#include <string>

namespace brittle {
namespace {

engine::Error badMesh(std::string message) { return {engine::ErrorCode::BadInput, std::move(message)}; }

std::vector<char> verticesOf(const ImportedMesh& imported, const std::vector<uint32_t>& triangles) {
    std::vector<char> used(imported.positions.size(), 0);
    for (const uint32_t t : triangles)
        for (const uint32_t v : imported.triangles[t])
            used[v] = 1;
    return used;
}

template <class Corner>
bool hasCollapsed(const Corner& a, const Corner& b, const Corner& c) {
    return a == b || b == c || c == a;
}

std::vector<uint32_t> withDistinctCorners(const ImportedMesh& imported) {
    std::vector<uint32_t> triangles;
    for (uint32_t t = 0; t < imported.triangles.size(); ++t) {
        const Index3& i = imported.triangles[t];
        if (!hasCollapsed(imported.positions[i[0]], imported.positions[i[1]], imported.positions[i[2]])) triangles.push_back(t);
    }
    return triangles;
}

engine::Result<Box> boxOf(const ImportedMesh& imported, const std::vector<char>& used) {
    Box box;
    for (size_t v = 0; v < used.size(); ++v) {
        if (!used[v]) continue;
        if (!isFinite(imported.positions[v]))
            return badMesh("vertex " + std::to_string(v) + ": a coordinate is not a finite number; remove that vertex");
        box.grow(imported.positions[v]);
    }
    const double diagonal = box.diagonal();
    if (!(diagonal >= kMinDiagonal && diagonal <= kMaxDiagonal))
        return badMesh("the model is " + formatNumber(diagonal) + " units large; scale it to between 1e-10 and 1e10");
    const double away = length(0.5 * (box.lower + box.upper));
    if (away > kFarthestModel * diagonal)
        return badMesh("the model is " + formatNumber(diagonal) + " units large and " + formatNumber(away) +
                       " from the origin, too far for its coordinates; move it closer");
    return box;
}

bool isSameBox(const Box& a, const Box& b) { return a.lower == b.lower && a.upper == b.upper; }

// Vertex of the file -> vertex of the mesh.
std::vector<uint32_t> weld(const ImportedMesh& imported, const std::vector<char>& used, Mesh& mesh, PrepareNotes& notes) {
    std::vector<uint32_t> index(used.size(), 0);
    Welder welder(used.size());
    uint32_t kept = 0;
    for (size_t v = 0; v < used.size(); ++v) {
        if (!used[v]) continue;
        ++kept;
        index[v] = welder.indexOf(toFloat(imported.positions[v] - mesh.center), mesh.positions);
    }
    notes.vertices_in = static_cast<uint32_t>(used.size());
    notes.unused = notes.vertices_in - kept;
    notes.welded = kept - static_cast<uint32_t>(mesh.positions.size());
    return index;
}

void addTriangle(const ImportedMesh& imported, uint32_t t, const Index3& triangle, Mesh& mesh) {
    mesh.triangles.push_back(triangle);
    for (size_t k = 0; k < 3; ++k) {
        mesh.corner_normals.push_back(imported.corner_normals[3 * t + k]);
        mesh.corner_uvs.push_back(imported.corner_uvs[3 * t + k]);
    }
}

// Of those triangles, about the middle of that box; the triangles that have not collapsed are left in the list.
WeldedMesh weldAround(const Box& box, const ImportedMesh& imported, const std::vector<char>& used,
                      std::vector<uint32_t>& triangles) {
    WeldedMesh welded;
    welded.mesh.center = 0.5 * (box.lower + box.upper);
    const std::vector<uint32_t> index = weld(imported, used, welded.mesh, welded.notes);
    std::erase_if(triangles, [&](uint32_t t) {
        const Index3& from = imported.triangles[t];
        const Index3 triangle = {index[from[0]], index[from[1]], index[from[2]]};
        if (hasCollapsed(triangle[0], triangle[1], triangle[2])) return true;
        addTriangle(imported, t, triangle, welded.mesh);
        return false;
    });
    welded.notes.collapsed = static_cast<uint32_t>(imported.triangles.size() - triangles.size());
    return welded;
}

// Reversed triangles for a mesh whose volume is negative: the solid is then what the surface encloses.
void turnInsideOut(Mesh& mesh) {
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
        std::swap(mesh.corner_normals[3 * t + 1], mesh.corner_normals[3 * t + 2]);
        std::swap(mesh.corner_uvs[3 * t + 1], mesh.corner_uvs[3 * t + 2]);
    }
}

// Normals of the file may point inward although the triangles do not, or were turned.
void pointNormalsOutward(Mesh& mesh) {
    double agreement = 0;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Index3& i = mesh.triangles[t];
        const Double3 a = toDouble(mesh.positions[i[0]]);
        const Double3 across = cross(toDouble(mesh.positions[i[1]]) - a, toDouble(mesh.positions[i[2]]) - a);
        for (size_t k = 0; k < 3; ++k) {
            const double along = dot(across, normalized(toDouble(mesh.corner_normals[3 * t + k]), {0, 0, 0}));
            if (std::isfinite(along)) agreement += along;
        }
    }
    if (agreement >= 0) return;
    for (Float3& normal : mesh.corner_normals)
        normal = {-normal[0], -normal[1], -normal[2]};
}

// Texture coordinates are carried along, never computed with: one that is no number would only spoil the output file.
void cleanUvs(Mesh& mesh) {
    for (Float2& uv : mesh.corner_uvs)
        if (!std::isfinite(uv[0]) || !std::isfinite(uv[1])) uv = {0, 0};
}

} // namespace

void dropUnusedPositions(Mesh& mesh) {
    constexpr uint32_t kUnused = 0xffffffff;
    std::vector<uint32_t> index(mesh.positions.size(), kUnused);
    for (const Index3& t : mesh.triangles)
        for (const uint32_t v : t)
            index[v] = 0;
    uint32_t kept = 0;
    for (size_t v = 0; v < index.size(); ++v) {
        if (index[v] == kUnused) continue;
        mesh.positions[kept] = mesh.positions[v];
        index[v] = kept++;
    }
    mesh.positions.resize(kept);
    for (Index3& t : mesh.triangles)
        for (uint32_t& v : t)
            v = index[v];
}

// A triangle that has collapsed may reach far beyond all others: the model is as large as what is left of it, and where that is
// less than before it is welded anew about its own middle.
engine::Result<WeldedMesh> weldMesh(const ImportedMesh& imported) {
    if (imported.triangles.empty()) return badMesh("no triangles in the model");
    std::vector<uint32_t> triangles = withDistinctCorners(imported);
    while (!triangles.empty()) {
        const std::vector<char> used = verticesOf(imported, triangles);
        const auto box = boxOf(imported, used);
        if (!box) return box.error();
        const size_t before = triangles.size();
        WeldedMesh welded = weldAround(*box, imported, used, triangles);
        if (triangles.size() == before) return welded;
        const auto left = boxOf(imported, verticesOf(imported, triangles));
        if (left && isSameBox(*left, *box)) return welded;
    }
    return badMesh("every triangle of the model has collapsed to a line or point");
}

PreparedMesh finishMesh(WeldedMesh welded) {
    PreparedMesh prepared{std::move(welded.mesh), {}, welded.notes};
    Mesh& mesh = prepared.mesh;
    dropUnusedPositions(mesh);
    prepared.notes.turned_inside_out = measureMesh(mesh).volume < 0;
    if (prepared.notes.turned_inside_out) turnInsideOut(mesh);
    pointNormalsOutward(mesh);
    cleanUvs(mesh);
    prepared.topology = buildTopology(mesh);
    completeNormals(mesh, prepared.topology);
    return prepared;
}

engine::Result<PreparedMesh> prepareMesh(const ImportedMesh& imported) {
    auto welded = weldMesh(imported);
    if (!welded) return welded.error();
    return finishMesh(std::move(*welded));
}

} // namespace brittle
