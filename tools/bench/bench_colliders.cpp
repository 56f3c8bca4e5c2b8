// Colliders of the bumpy sphere's fragments: what each number of directions costs, and how close it comes.
#include "tools/bench/bench.h"
#include "tools/bench/our_side.h"

#include <algorithm>
#include <array>

namespace bench {
namespace {

constexpr std::array<std::string_view, 3> kStages = {"support_heights", "part_islands", "collider"};
constexpr std::array<std::string_view, 8> kKernels = {"list_fragments",     "measure_supports",  "take_surfaces",
                                                      "count_island_pairs", "flag_island_pairs", "part_islands",
                                                      "cut_colliders",      "emit_colliders"};

bool isOfColliders(const std::string& name, auto names) {
    return std::ranges::any_of(names, [&](std::string_view known) { return name.starts_with(known); });
}

double excessOf(const brittle::FragmentSet& set) {
    double fragments = 0, pieces = 0;
    for (const brittle::Fragment& fragment : set.fragments)
        fragments += fragment.volume;
    for (const brittle::ColliderPiece& piece : set.colliders.pieces)
        pieces += volumeOf(set.colliders, piece);
    return pieces / fragments - 1;
}

engine::Result<ColliderRow> rowOf(brittle::Fracture& fracture, const brittle::PreparedMesh& model,
                                  const brittle::FractureOptions& options, uint32_t rounds) {
    ColliderRow row{static_cast<uint32_t>(options.given_sites.size()), options.collider};
    std::vector<double> ms, shatter_ms;
    for (uint32_t round = 0; round <= rounds; ++round) {
        const auto result = fracture.shatter(model.mesh, model.topology, options);
        if (!result) return result.error();
        if (round == 0) continue; // kernels are made
        double own = 0, all = 0;
        for (const engine::Timing& timing : result->timings) {
            all += timing.ms;
            own += isOfColliders(timing.name, kStages) ? timing.ms : 0;
        }
        ms.push_back(own);
        shatter_ms.push_back(all - own);
        row.pieces = result->fragments.colliders.pieces.size();
        row.planes = result->fragments.colliders.faces.size();
        row.volume_excess = excessOf(result->fragments);
    }
    row.ms = median(ms);
    row.shatter_ms = median(shatter_ms);
    return row;
}

} // namespace

engine::Result<std::vector<ColliderRow>> benchColliders(engine::Device& device, const BenchOptions& options,
                                                        const Progress& progress) {
    auto model = prepared(bumpySphere(options.sphere_level));
    if (!model) return model.error();
    auto fracture = brittle::Fracture::create(device, options.group_size);
    if (!fracture) return fracture.error();
    std::vector<ColliderRow> rows;
    for (const uint32_t count : options.shatter_counts) {
        for (const uint32_t directions : options.collider_directions) {
            progress("colliders of " + std::to_string(directions) + " directions for " + std::to_string(count) + " cells");
            brittle::FractureOptions broken;
            broken.given_sites = uniformSites(count, options.seed);
            broken.collider = directions;
            auto row = rowOf(**fracture, *model, broken, options.rounds);
            if (!row) return row.error();
            rows.push_back(std::move(*row));
            if (!options.kernels) continue;
            auto kernels = kernelTimes(**fracture, *model, broken, options.rounds);
            if (!kernels) return kernels.error();
            std::erase_if(*kernels, [](const auto& kernel) { return !isOfColliders(kernel.first, kKernels); });
            rows.back().kernels = std::move(*kernels);
        }
    }
    return rows;
}

} // namespace bench
