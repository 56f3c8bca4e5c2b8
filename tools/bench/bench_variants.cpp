// What the ways to the same cells cost, and what less exact decisions save: searches, mappings and precisions, one at a time
// against the default.
#include "tools/bench/bench.h"
#include "tools/bench/our_side.h"

namespace bench {
namespace {

struct Variant {
    const char* name;
    brittle::Search search;
    brittle::CellMapping cells;
    brittle::Precision precision;
};

constexpr Variant kVariants[] = {
    {"default", brittle::Search::Grid, brittle::CellMapping::Lanes, brittle::Precision::Exact},
    {"search sphere_tree", brittle::Search::SphereTree, brittle::CellMapping::Lanes, brittle::Precision::Exact},
    {"search linear", brittle::Search::Linear, brittle::CellMapping::Lanes, brittle::Precision::Exact},
    {"cells edges", brittle::Search::Grid, brittle::CellMapping::Edges, brittle::Precision::Exact},
    {"precision double", brittle::Search::Grid, brittle::CellMapping::Lanes, brittle::Precision::Double},
    {"precision fast", brittle::Search::Grid, brittle::CellMapping::Lanes, brittle::Precision::Fast},
    {"cells edges, precision fast", brittle::Search::Grid, brittle::CellMapping::Edges, brittle::Precision::Fast},
};

brittle::FractureOptions optionsOf(const Variant& variant, const std::vector<Point>& sites) {
    brittle::FractureOptions options;
    options.given_sites = sites;
    options.search = variant.search;
    options.cells = variant.cells;
    options.precision = variant.precision;
    return options;
}

bool isFor(const engine::Device& device, const Variant& variant) {
    return variant.precision != brittle::Precision::Double || device.features().doubles;
}

// One run: the stages that differ between the ways to cells, or everything on the device.
engine::Result<double> milliseconds(brittle::Fracture& fracture, const brittle::PreparedMesh& model,
                                    const brittle::FractureOptions& options) {
    const auto result = fracture.shatter(model.mesh, model.topology, options);
    if (!result) return result.error();
    return options.only_cells ? stageMs(*result, {"neighbor_grid", "sphere_tree", "cut_cells"}) : result->total_ms;
}

// The variants take turns, so that a machine that is busy for a while is busy for all of them.
engine::Result<std::vector<VariantRow>> measure(engine::Device& device, brittle::Fracture& fracture,
                                                const brittle::PreparedMesh& model, uint32_t count, bool only_cells,
                                                const BenchOptions& options) {
    const std::vector<Point> sites = uniformSites(count, options.seed);
    std::vector<std::vector<double>> samples(std::size(kVariants));
    for (uint32_t round = 0; round <= options.rounds; ++round)
        for (size_t k = 0; k < std::size(kVariants); ++k) {
            if (!isFor(device, kVariants[k])) continue;
            brittle::FractureOptions asked = optionsOf(kVariants[k], sites);
            asked.only_cells = only_cells;
            const auto ms = milliseconds(fracture, model, asked);
            if (!ms) return ms.error();
            if (round > 0) samples[k].push_back(*ms); // the first warms up
        }
    std::vector<VariantRow> rows;
    for (size_t k = 0; k < std::size(kVariants); ++k)
        if (!samples[k].empty()) rows.push_back({kVariants[k].name, count, only_cells, median(samples[k]), median(samples[0])});
    return rows;
}

} // namespace

engine::Result<std::vector<VariantRow>> benchVariants(engine::Device& device, const BenchOptions& options,
                                                      const Progress& progress) {
    auto cube = prepared(unitCube());
    if (!cube) return cube.error();
    auto sphere = prepared(bumpySphere(options.sphere_level));
    if (!sphere) return sphere.error();
    auto fracture = brittle::Fracture::create(device, options.group_size);
    if (!fracture) return fracture.error();
    std::vector<VariantRow> rows;
    for (const bool only_cells : {true, false})
        for (const uint32_t count : only_cells ? options.variant_cell_counts : options.variant_shatter_counts) {
            progress(std::string(only_cells ? "cells" : "whole shatter") + " of " + std::to_string(count) +
                     " sites, in all ways");
            const auto more = measure(device, **fracture, only_cells ? *cube : *sphere, count, only_cells, options);
            if (!more) return more.error();
            rows.insert(rows.end(), more->begin(), more->end());
        }
    return rows;
}

} // namespace bench
