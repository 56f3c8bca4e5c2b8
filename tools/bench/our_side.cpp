#include "tools/bench/our_side.h"

#include <algorithm>
#include <map>

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

engine::Result<Times> kernelTimes(brittle::Fracture& fracture, const brittle::PreparedMesh& model,
                                  brittle::FractureOptions options, uint32_t rounds) {
    options.time_kernels = true;
    std::map<std::string, std::vector<double>> samples;
    for (uint32_t round = 0; round < rounds; ++round) {
        auto result = fracture.shatter(model.mesh, model.topology, options);
        if (!result) return result.error();
        for (const engine::Timing& timing : result->timings)
            samples[timing.name].push_back(timing.ms);
    }
    Times times;
    for (const auto& [name, ms] : samples)
        times.emplace_back(name, median(ms));
    std::ranges::sort(times, std::ranges::greater{}, &Times::value_type::second);
    return times;
}

} // namespace bench
