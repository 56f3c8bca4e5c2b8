// A closed model that is not convex, shattered whole: milliseconds, the share of each stage, and CGAL's time for the same.
#include "tools/bench/bench.h"
#include "tools/bench/our_side.h"
#include "tools/bench/peers.h"

#include <chrono>
#include <map>

namespace bench {
namespace {

struct ShatterSamples {
    std::vector<double> call, device, cgal; // milliseconds

    std::map<std::string, std::vector<double>> stages;
    std::vector<std::string> stage_order;
    size_t fragments = 0;
};

engine::Result<void> runOurs(brittle::Fracture& fracture, const brittle::PreparedMesh& model, const std::vector<Point>& sites,
                             ShatterSamples& samples) {
    brittle::FractureOptions options;
    options.given_sites = sites;
    const auto begin = std::chrono::steady_clock::now();
    auto result = fracture.shatter(model.mesh, model.topology, options);
    const std::chrono::duration<double, std::milli> call = std::chrono::steady_clock::now() - begin;
    if (!result) return result.error();
    samples.call.push_back(call.count());
    samples.device.push_back(result->total_ms);
    samples.fragments = result->fragments.fragments.size();
    samples.stage_order.clear();
    for (const engine::Timing& timing : result->timings) {
        samples.stages[timing.name].push_back(timing.ms);
        samples.stage_order.push_back(timing.name);
    }
    return {};
}

ShatterRow rowOf(uint32_t count, size_t triangles, const ShatterSamples& samples) {
    ShatterRow row{count, triangles, samples.fragments, median(samples.call), median(samples.device), median(samples.cgal),
                   {},    {}};
    for (const std::string& name : samples.stage_order)
        row.stages.emplace_back(name, median(samples.stages.at(name)));
    return row;
}

engine::Result<ShatterSamples> alternate(brittle::Fracture& fracture, const brittle::PreparedMesh& model, uint32_t count,
                                         const BenchOptions& options, bool with_peer) {
    const std::vector<Point> sites = uniformSites(count, options.seed);
    ShatterSamples warm_up, samples;
    if (auto done = runOurs(fracture, model, sites, warm_up); !done) return done.error();
    for (uint32_t round = 0; round < options.rounds; ++round) {
        if (auto done = runOurs(fracture, model, sites, samples); !done) return done.error();
        if (!with_peer || !options.peers || count > options.peer_shatter_limit) continue;
        if (const auto peer = cgalShatter(options.sphere_level, count, options.seed)) samples.cgal.push_back(peer->ms);
    }
    return samples;
}

} // namespace

engine::Result<std::vector<ShatterRow>> benchShatter(engine::Device& device, const BenchOptions& options,
                                                     const Progress& progress) {
    auto model = prepared(bumpySphere(options.sphere_level));
    if (!model) return model.error();
    auto fracture = brittle::Fracture::create(device, options.group_size);
    if (!fracture) return fracture.error();
    std::vector<ShatterRow> rows;
    for (const uint32_t count : options.only_colliders ? std::vector<uint32_t>{} : options.shatter_counts) {
        progress("whole shatter into " + std::to_string(count) + " cells");
        const auto samples = alternate(**fracture, *model, count, options, true);
        if (!samples) return samples.error();
        rows.push_back(rowOf(count, model->mesh.triangles.size(), *samples));
        if (!options.kernels) continue;
        brittle::FractureOptions broken;
        broken.given_sites = uniformSites(count, options.seed);
        auto kernels = kernelTimes(**fracture, *model, broken, options.rounds);
        if (!kernels) return kernels.error();
        rows.back().kernels = std::move(*kernels);
    }
    return rows;
}

engine::Result<std::vector<ShatterRow>> benchGrowth(engine::Device& device, const BenchOptions& options,
                                                    const Progress& progress) {
    auto fracture = brittle::Fracture::create(device, options.group_size);
    if (!fracture) return fracture.error();
    std::vector<ShatterRow> rows;
    for (const uint32_t level : options.growth_levels) {
        auto model = prepared(bumpySphere(level));
        if (!model) return model.error();
        progress("whole shatter of " + std::to_string(model->mesh.triangles.size()) + " triangles");
        const auto samples = alternate(**fracture, *model, options.growth_sites, options, false);
        if (!samples) return samples.error();
        rows.push_back(rowOf(options.growth_sites, model->mesh.triangles.size(), *samples));
    }
    return rows;
}

} // namespace bench
