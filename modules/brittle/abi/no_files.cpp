// The library reads no files: a host hands over meshes. With this in place of mesh/import.cpp, which the linker then leaves
// out, no host loads assimp, Draco or meshoptimizer, and none is forked to read a model.
#include "modules/brittle/mesh/import.h"

namespace brittle {
namespace {

engine::Error refusal() {
    return {engine::ErrorCode::BadInput, "the library reads no model files; hand the mesh over in memory"};
}

} // namespace

engine::Result<ImportedMesh> importMesh(const std::filesystem::path&) { return refusal(); }
engine::Result<ImportedMesh> importMesh(std::string_view, std::string_view, const engine::IsolationLimits&) {
    return refusal();
}
engine::Result<ImportedMesh> importMesh(std::string_view, std::string_view) { return refusal(); }

} // namespace brittle
