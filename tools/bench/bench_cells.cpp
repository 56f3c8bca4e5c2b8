// Voronoi cells of uniform sites in a cube: microseconds a cell, ours and Voro++'s.
#include "tools/bench/bench.h"
#include "tools/bench/our_side.h"
#include "tools/bench/peers.h"

namespace bench {
namespace {

brittle::FractureOptions onlyCells(const std::vector<Point>& sites) {
    brittle::FractureOptions options;
    options.given_sites = sites;
    options.only_cells = true;
    return options;
}

struct CellTimes {
    double cut = 0, link = 0;
};

// One run of ours. Binning the sites belongs to it, as filling the container belongs to Voro++'s time.
engine::Result<CellTimes> ourCells(brittle::Fracture& fracture, const brittle::PreparedMesh& cube,
                                   const std::vector<Point>& sites) {
    auto result = fracture.shatter(cube.mesh, cube.topology, onlyCells(sites));
    if (!result) return result.error();
    return CellTimes{stageMs(*result, {"neighbor_grid", "cut_cells"}), stageMs(*result, {"link_cells"})};
}

// Each side runs twice in a row and the second run counts. The first after the other side's finds the scheduler still spreading
// threads over cores and caches full of something else: up to a third more for a device of several threads, and chance.
auto settled(const auto& run) {
    (void)run();
    return run();
}

struct CellSamples {
    std::vector<double> cut, link, voropp;
};

engine::Result<CellSamples> alternate(brittle::Fracture& fracture, const brittle::PreparedMesh& cube,
                                      const std::vector<Point>& sites, const BenchOptions& options) {
    CellSamples samples;
    if (auto warm_up = ourCells(fracture, cube, sites); !warm_up) return warm_up.error();
    for (uint32_t round = 0; round < options.rounds; ++round) {
        const auto ms = settled([&] { return ourCells(fracture, cube, sites); });
        if (!ms) return ms.error();
        samples.cut.push_back(ms->cut);
        samples.link.push_back(ms->link);
        if (!options.peers) continue;
        if (const auto peer = settled([&] { return voroppCells(sites); })) samples.voropp.push_back(peer->ms);
    }
    return samples;
}

} // namespace

engine::Result<std::vector<CellsRow>> benchCells(engine::Device& device, const BenchOptions& options,
                                                 const Progress& progress) {
    auto cube = prepared(unitCube());
    if (!cube) return cube.error();
    auto fracture = brittle::Fracture::create(device, options.group_size);
    if (!fracture) return fracture.error();
    std::vector<CellsRow> rows;
    for (const uint32_t count : options.cell_counts) {
        progress("cells of " + std::to_string(count) + " sites");
        const auto samples = alternate(**fracture, *cube, uniformSites(count, options.seed), options);
        if (!samples) return samples.error();
        rows.push_back({count, median(samples->cut), median(samples->link), median(samples->voropp), {}});
        if (!options.kernels) continue;
        auto kernels = kernelTimes(**fracture, *cube, onlyCells(uniformSites(count, options.seed)), options.rounds);
        if (!kernels) return kernels.error();
        rows.back().kernels = std::move(*kernels);
    }
    return rows;
}

} // namespace bench
