#include "tools/bench/our_side.h"

#include <algorithm>

namespace bench {

engine::Result<brittle::PreparedMesh> prepared(const Model& model) {
    brittle::ImportedMesh imported;
    imported.positions = model.vertices;
    imported.triangles = model.triangles;
    imported.corner_normals.resize(3 * model.triangles.size(), {0, 0, 0});
    imported.corner_uvs.resize(3 * model.triangles.size(), {0, 0});
    return brittle::prepareMesh(imported);
}

double stageMs(const brittle::FractureResult& result, std::initializer_list<std::string_view> stages) {
    double ms = 0;
    for (const engine::Timing& timing : result.timings)
        if (std::find(stages.begin(), stages.end(), timing.name) != stages.end()) ms += timing.ms;
    return ms;
}

} // namespace bench
