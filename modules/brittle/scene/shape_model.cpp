#include "modules/brittle/scene/shape_model.h"

#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/primitives.h"
#include "modules/brittle/mesh/vector_math.h"

namespace brittle {
namespace {

// Normals stretch by the inverse; only their direction is meant.
Float3 scaledNormal(const Float3& normal, const Double3& scale) {
    const Double3 stretched = {normal[0] / scale[0], normal[1] / scale[1], normal[2] / scale[2]};
    return toFloat(normalized(stretched, {0, 0, 0}));
}

engine::Result<ImportedMesh> unscaledModel(const ShapeDescription& shape, const std::filesystem::path& folder) {
    const std::string_view file = shape.file;
    if (shape.model) return *shape.model;
    return file.starts_with(kBuiltinModel) ? makeBuiltin(file.substr(kBuiltinModel.size())) : importMesh(folder / shape.file);
}

} // namespace

engine::Result<ImportedMesh> readModel(const ShapeDescription& shape, const std::filesystem::path& folder) {
    auto model = unscaledModel(shape, folder);
    if (!model) return model;
    for (Double3& p : model->positions)
        for (size_t c = 0; c < 3; ++c)
            p[c] *= shape.scale[c];
    for (Float3& normal : model->corner_normals)
        normal = scaledNormal(normal, shape.scale);
    return model;
}

} // namespace brittle
