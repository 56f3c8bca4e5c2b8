#include "modules/brittle/abi/boundary.h"
#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/prepare.h"

#include <cmath>
#include <cstring>

namespace {

using namespace brittle::abi;
using brittle::ImportedMesh;

constexpr uint32_t kMostIndices = 9'000'000;

uint32_t strideOf(uint32_t given, uint32_t tight, const char* name) {
    if (given % 4 != 0 || (given != 0 && given < tight))
        throw Refusal(BRITTLE_BAD_VALUE,
                      std::string("'") + name + "' has to be 0, or a multiple of 4 that is not below " + std::to_string(tight));
    return given != 0 ? given : tight;
}

// The numbers of one vertex.
template <size_t n>
std::array<float, n> at(const float* list, uint32_t stride, uint32_t vertex, const char* name) {
    std::array<float, n> values;
    std::memcpy(values.data(), reinterpret_cast<const std::byte*>(list) + size_t{stride} * vertex, sizeof values);
    for (const float value : values)
        if (!std::isfinite(value))
            throw Refusal(BRITTLE_BAD_VALUE, std::string(name) + " of vertex " + std::to_string(vertex) + " are no numbers");
    return values;
}

void readPositions(const BrittleMeshDef& def, ImportedMesh& mesh) {
    const uint32_t stride = strideOf(def.position_stride, 12, "position_stride");
    for (uint32_t k = 0; k < def.vertex_count; ++k) {
        const auto p = at<3>(def.positions, stride, k, "positions");
        mesh.positions.push_back({p[0], p[1], p[2]});
    }
}

void readTriangles(const BrittleMeshDef& def, ImportedMesh& mesh) {
    const uint32_t normal_stride = strideOf(def.normal_stride, 12, "normal_stride"),
                   uv_stride = strideOf(def.uv_stride, 8, "uv_stride");
    for (uint32_t k = 0; k < def.index_count; ++k) {
        const uint32_t vertex = def.indices[k];
        if (vertex >= def.vertex_count)
            throw Refusal(BRITTLE_BAD_VALUE, "index " + std::to_string(k) + " is " + std::to_string(vertex) + ", there are " +
                                                 std::to_string(def.vertex_count) + " vertices");
        if (k % 3 == 0) mesh.triangles.push_back({});
        mesh.triangles.back()[k % 3] = vertex;
        mesh.corner_normals.push_back(def.normals != nullptr ? at<3>(def.normals, normal_stride, vertex, "normals")
                                                             : brittle::Float3{0, 0, 0});
        mesh.corner_uvs.push_back(def.uvs != nullptr ? at<2>(def.uvs, uv_stride, vertex, "uvs") : brittle::Float2{0, 0});
    }
}

ImportedMesh meshOf(const BrittleMeshDef& def) {
    needed(def.positions, "positions");
    needed(def.indices, "indices");
    if (def.index_count == 0 || def.index_count % 3 != 0 || def.index_count > kMostIndices)
        throw Refusal(BRITTLE_BAD_VALUE, "'index_count' has to be a multiple of 3, from 3 to 9,000,000");
    if (def.vertex_count == 0 || def.vertex_count > kMostIndices)
        throw Refusal(BRITTLE_BAD_VALUE, "'vertex_count' has to be from 1 to 9,000,000");
    ImportedMesh mesh;
    readPositions(def, mesh);
    readTriangles(def, mesh);
    return mesh;
}

void checkSolid(const ImportedMesh& mesh) {
    const auto prepared = orRefuse(brittle::prepareMesh(mesh), BRITTLE_BAD_MESH);
    orRefuse(brittle::checkMesh(prepared.mesh, prepared.topology), BRITTLE_BAD_MESH);
}

} // namespace

BrittleResult brittleCreateMesh(BrittleContext* context, const BrittleMeshDef* def, BrittleMesh* mesh) {
    return bounded(context, [&](BrittleContext& c) {
        const BrittleMeshDef& d = sized(def, "def");
        BrittleMesh& out = needed(mesh, "mesh");
        HostedMesh hosted = {std::make_shared<const ImportedMesh>(meshOf(d)), d.is_open != 0};
        if (!hosted.is_open) checkSolid(*hosted.model);
        out.id = c.meshes.add(std::move(hosted));
    });
}

BrittleResult brittleDestroyMesh(BrittleContext* context, BrittleMesh mesh) {
    return bounded(context, [&](BrittleContext& c) { c.meshes.remove(mesh.id); });
}
