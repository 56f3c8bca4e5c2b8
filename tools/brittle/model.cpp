#include "tools/brittle/model.h"

#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/primitives.h"

namespace cli {

engine::Result<brittle::PreparedMesh> loadModel(const std::string& name) {
    constexpr std::string_view kBuiltin = "builtin:";
    const bool is_builtin = name.starts_with(kBuiltin);
    const auto imported = is_builtin ? brittle::makeBuiltin(name.substr(kBuiltin.size())) : brittle::importMesh(name);
    if (!imported) return imported.error();
    auto prepared = brittle::prepareMesh(*imported);
    if (!prepared) return engine::Error{prepared.error().code, name + ": " + prepared.error().message};
    return prepared;
}

} // namespace cli
