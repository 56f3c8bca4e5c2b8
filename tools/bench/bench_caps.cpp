// What it costs to cap solids of any shape, next to the paper's caps, on a sphere, where both are right.
#include "tools/bench/bench.h"
#include "tools/bench/our_side.h"

#include <chrono>

namespace bench {
namespace {

struct CapSamples {
    std::vector<double> call, caps; // milliseconds
};

engine::Result<void> measureOnce(brittle::Fracture& fracture, const brittle::PreparedMesh& model,
                                 const brittle::FractureOptions& options, CapSamples& samples) {
    const auto begin = std::chrono::steady_clock::now();
    auto result = fracture.shatter(model.mesh, model.topology, options);
    const std::chrono::duration<double, std::milli> call = std::chrono::steady_clock::now() - begin;
    if (!result) return result.error();
    samples.call.push_back(call.count());
    samples.caps.push_back(stageMs(*result, {"cap_faces"}));
    return {};
}

engine::Result<CapsRow> alternate(brittle::Fracture& fracture, const brittle::PreparedMesh& model, uint32_t count,
                                  const BenchOptions& options) {
    brittle::FractureOptions exact, convex;
    exact.given_sites = convex.given_sites = uniformSites(count, options.seed);
    convex.caps = brittle::Caps::Convex;
    CapSamples warm_up, of_exact, of_convex;
    for (uint32_t round = 0; round <= options.rounds; ++round) {
        if (auto done = measureOnce(fracture, model, exact, round == 0 ? warm_up : of_exact); !done) return done.error();
        if (auto done = measureOnce(fracture, model, convex, round == 0 ? warm_up : of_convex); !done) return done.error();
    }
    return CapsRow{count,
                   model.mesh.triangles.size(),
                   median(of_exact.call),
                   median(of_convex.call),
                   median(of_exact.caps),
                   median(of_convex.caps)};
}

} // namespace

engine::Result<std::vector<CapsRow>> benchCaps(engine::Device& device, const BenchOptions& options, const Progress& progress) {
    auto model = prepared(smoothSphere(options.sphere_level));
    if (!model) return model.error();
    auto fracture = brittle::Fracture::create(device, options.group_size);
    if (!fracture) return fracture.error();
    std::vector<CapsRow> rows;
    for (const uint32_t count : options.shatter_counts) {
        progress("caps of a sphere in " + std::to_string(count) + " cells");
        auto row = alternate(**fracture, *model, count, options);
        if (!row) return row.error();
        rows.push_back(*row);
    }
    return rows;
}

} // namespace bench
