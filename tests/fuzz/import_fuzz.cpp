// Hostile bytes through everything that a model file goes through before anything is broken: reading, preparing, checking, and
// mending. One program per format; BRITTLE_FUZZ_ENDING says which.
//
// What the sanitizers see is theirs to tell. On top of that: what is called mended is sound, and a mended model is not mended
// a second time.
#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/diagnosis.h"
#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/repair/repair.h"
#include "tests/fuzz/require.h"

using namespace brittle;

namespace {

void requireOneLine(const engine::Error& error) {
    require(!error.message.empty() && error.message.find('\n') == std::string::npos, "an error is one line");
}

ImportedMesh asImported(const Mesh& mesh) {
    ImportedMesh imported;
    for (const Float3& p : mesh.positions)
        imported.positions.push_back({static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    imported.triangles = mesh.triangles;
    imported.corner_normals = mesh.corner_normals;
    imported.corner_uvs = mesh.corner_uvs;
    return imported;
}

void examine(const ImportedMesh& imported) {
    const auto model = prepareMesh(imported);
    if (!model) return requireOneLine(model.error());
    const MeshDiagnosis diagnosis = diagnoseMesh(model->mesh, model->topology);
    const auto checked = checkMesh(model->mesh, model->topology);
    require(checked.has_value() == diagnosis.report.isSound(), "the doctor and the check agree");
    if (!checked) requireOneLine(checked.error());
}

void mend(const ImportedMesh& imported) {
    const auto repaired = repairMesh(imported);
    if (!repaired) return requireOneLine(repaired.error());
    const auto checked = checkMesh(repaired->model.mesh, repaired->model.topology);
    require(checked.has_value(), "what is mended is sound");
    require(checked->measures.volume > 0, "what is mended has a volume");
    const auto again = repairMesh(asImported(repaired->model.mesh));
    require(again.has_value() && again->notes.isEmpty(), "what is mended needs no mending");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const auto imported = importMesh(bytes, BRITTLE_FUZZ_ENDING, {.seconds = 2, .bytes = uint64_t{1} << 30});
    if (!imported) {
        requireOneLine(imported.error());
        return 0;
    }
    examine(*imported);
    mend(*imported);
    return 0;
}
