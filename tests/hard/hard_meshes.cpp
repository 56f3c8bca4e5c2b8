#include "tests/hard/hard_meshes.h"

#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/mesh/primitives.h"

#include <cmath>
#include <limits>

namespace hard {
namespace {

using brittle::Double3, brittle::Index3, brittle::ImportedMesh;

void dropTriangle(ImportedMesh& mesh) {
    mesh.triangles.pop_back();
    mesh.corner_normals.resize(3 * mesh.triangles.size());
    mesh.corner_uvs.resize(3 * mesh.triangles.size());
}

void addTriangle(ImportedMesh& mesh, const Index3& triangle) {
    mesh.triangles.push_back(triangle);
    mesh.corner_normals.resize(3 * mesh.triangles.size());
    mesh.corner_uvs.resize(3 * mesh.triangles.size());
}

void add(ImportedMesh& mesh, const ImportedMesh& other, const Double3& by) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const Double3& p : other.positions)
        mesh.positions.push_back({p[0] + by[0], p[1] + by[1], p[2] + by[2]});
    for (const Index3& t : other.triangles)
        addTriangle(mesh, {t[0] + first, t[1] + first, t[2] + first});
}

ImportedMesh withHole() {
    ImportedMesh mesh = brittle::makeCube();
    dropTriangle(mesh);
    return mesh;
}

ImportedMesh withFin() {
    ImportedMesh mesh = brittle::makeCube();
    mesh.positions.push_back({2, 0, 0});
    const Index3 t = mesh.triangles[0];
    addTriangle(mesh, {t[0], t[1], static_cast<uint32_t>(mesh.positions.size() - 1)});
    return mesh;
}

ImportedMesh turnedInPart() {
    ImportedMesh mesh = brittle::makeCube();
    std::swap(mesh.triangles[3][1], mesh.triangles[3][2]);
    return mesh;
}

ImportedMesh doubled() {
    ImportedMesh mesh = brittle::makeCube();
    addTriangle(mesh, mesh.triangles[0]);
    return mesh;
}

ImportedMesh crossing() {
    ImportedMesh mesh = brittle::makeCube();
    add(mesh, brittle::makeCube(), {.3, .4, .2});
    return mesh;
}

ImportedMesh flat() {
    ImportedMesh mesh = brittle::makeCube();
    for (Double3& p : mesh.positions)
        p[2] = 0;
    return mesh;
}

ImportedMesh withOneCoordinate(double x) {
    ImportedMesh mesh = brittle::makeCube();
    mesh.positions[3][1] = x;
    return mesh;
}
ImportedMesh withoutNumber() { return withOneCoordinate(std::numeric_limits<double>::quiet_NaN()); }
ImportedMesh endless() { return withOneCoordinate(std::numeric_limits<double>::infinity()); }

ImportedMesh scaled(double scale) {
    ImportedMesh mesh = brittle::makeCube();
    for (Double3& p : mesh.positions)
        for (double& x : p)
            x *= scale;
    return mesh;
}
ImportedMesh tooSmall() { return scaled(1e-12); }
ImportedMesh tooLarge() { return scaled(1e12); }

ImportedMesh collapsed() { return scaled(0); }

constexpr MeshCase kCases[] = {
    {"mesh with a hole", withHole, "open"},
    {"mesh with a fin", withFin, "edge"},
    {"mesh turned over in part", turnedInPart, "edge"},
    {"mesh with a doubled triangle", doubled, "triangle"},
    {"mesh that crosses itself", crossing, "cross"},
    {"flat mesh", flat, ""},
    {"coordinate that is no number", withoutNumber, "vertex 3"},
    {"coordinate without end", endless, "vertex 3"},
    {"mesh of size 1e-12", tooSmall, "scale it"},
    {"mesh of size 1e12", tooLarge, "scale it"},
    {"mesh collapsed to a point", collapsed, ""},
};

engine::Result<void> takenAsSound(const ImportedMesh& imported) {
    const auto prepared = brittle::prepareMesh(imported);
    if (!prepared) return prepared.error();
    const auto report = brittle::checkMesh(prepared->mesh, prepared->topology);
    if (!report) return report.error();
    return {};
}

} // namespace

std::span<const MeshCase> meshCases() { return kCases; }

void measureMesh(Trial& trial, const MeshCase& self) {
    const auto taken = takenAsSound(self.make());
    trial.check("taken as a solid", taken ? 1 : 0, 0);
    if (taken) return;
    const bool says =
        taken.error().code == engine::ErrorCode::BadInput && taken.error().message.find(self.says) != std::string::npos;
    trial.check("refusals that do not say why: " + taken.error().message, says ? 0 : 1, 0);
}

} // namespace hard
