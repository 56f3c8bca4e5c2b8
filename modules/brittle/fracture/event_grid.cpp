#include "modules/brittle/fracture/event_grid.h"

#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/measures.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace brittle {
namespace {

constexpr double kSitesPerBin = 2.0;
constexpr double kLeastShare = 1.0 / 32; // of the bins that sites fall into: finer ones are not made
constexpr double kFarthestSite = 256.0;  // from the mesh's center, in its farthest coordinates: halves of its size

Int3 snapVertex(const EventGrid& grid, const Float3& p) { return snapToGrid(grid, {p[0], p[1], p[2]}); }

engine::Result<double> farthestSite(std::span<const Double3> sites, double mesh_reach) {
    double reach = mesh_reach;
    for (size_t k = 0; k < sites.size(); k++) {
        for (double x : sites[k]) {
            if (!std::isfinite(x) || std::fabs(x) > kFarthestSite * mesh_reach)
                return engine::Error{engine::ErrorCode::BadInput,
                                     "site " + std::to_string(k + 1) + " of those given is not finite or lies more than " +
                                         std::to_string(static_cast<int>(kFarthestSite / 2)) +
                                         " times the model's size away; remove it or move it closer"};
            reach = std::max(reach, std::fabs(x));
        }
    }
    return reach;
}

void setBox(EventGrid& grid, const Mesh& mesh, std::span<const Double3> sites) {
    grid.mesh_low = {1 << 24, 1 << 24, 1 << 24};
    grid.mesh_high = {0, 0, 0};
    auto extend = [](Int3& low, Int3& high, const Int3& p) {
        for (size_t k = 0; k < 3; k++) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    };
    for (const Float3& p : mesh.positions)
        extend(grid.mesh_low, grid.mesh_high, snapVertex(grid, p));
    grid.box_low = grid.mesh_low;
    grid.box_high = grid.mesh_high;
    for (const Double3& s : sites)
        extend(grid.box_low, grid.box_high, snapToGrid(grid, s));
    for (size_t k = 0; k < 3; k++) {
        grid.box_low[k] -= kGridMargin;
        grid.box_high[k] += kGridMargin;
    }
}

uint64_t binsOfEdge(const EventGrid& grid, int64_t edge, Int4& bins) {
    uint64_t total = 1;
    for (size_t k = 0; k < 3; k++) {
        int64_t extent = grid.box_high[k] - grid.box_low[k] + 1;
        bins[k] = static_cast<int32_t>((extent + edge - 1) / edge);
        total *= static_cast<uint64_t>(bins[k]);
    }
    bins[3] = static_cast<int32_t>(edge);
    return total;
}

// Share of the box that the solid fills: where sites are placed inside, bins outside stay empty.
double filledShare(const EventGrid& grid) {
    double box = 1;
    for (size_t k = 0; k < 3; k++)
        box *= grid.box_high[k] - grid.box_low[k] + 1.0;
    return std::clamp(grid.solid_volume / box, kLeastShare, 1.0);
}

std::vector<uint32_t> countInBins(const EventGrid& grid, std::span<const Double3> sites) {
    std::vector<uint32_t> counts(grid.binCount(), 0);
    for (const Double3& s : sites) {
        Int3 p = snapToGrid(grid, s);
        uint64_t bin = 0;
        for (size_t k = 3; k-- > 0;) {
            int32_t at = std::min((p[k] - grid.box_low[k]) / grid.bins[3], grid.bins[k] - 1);
            bin = bin * static_cast<uint64_t>(grid.bins[k]) + static_cast<uint64_t>(at);
        }
        counts[bin]++;
    }
    return counts;
}

// Share of evenly laid bins that any site falls into: what clusters leave empty, finer bins make up for.
double occupiedShare(const EventGrid& grid, std::span<const Double3> sites) {
    const std::vector<uint32_t> counts = countInBins(grid, sites);
    const auto empty = static_cast<double>(std::ranges::count(counts, 0u));
    return std::clamp(1 - empty / static_cast<double>(counts.size()), kLeastShare, 1.0);
}

// The finest cubic bins of which there are no more than the sites call for.
void setBins(EventGrid& grid, uint32_t site_count, double filled) {
    auto wanted = std::max<uint64_t>(1, static_cast<uint64_t>(site_count / kSitesPerBin / filled));
    int64_t low = 1, high = 1 << 25;
    Int4 bins{};
    while (low < high) {
        int64_t middle = (low + high) / 2;
        if (binsOfEdge(grid, middle, bins) <= wanted)
            high = middle;
        else
            low = middle + 1;
    }
    binsOfEdge(grid, low, grid.bins);
}

} // namespace

EventGrid gridOfTiles(uint32_t tiles, uint32_t most_sites) {
    EventGrid grid;
    grid.scale = kTileScale;
    grid.step = 1 / kTileScale;
    grid.mesh_high = {1 << 24, 1 << 24, 1 << 24};
    grid.tiles = tiles;
    const int32_t per_axis = std::clamp(static_cast<int32_t>(std::cbrt(most_sites / kSitesPerBin)), 1, 64);
    for (size_t k = 0; k < 3; ++k) {
        grid.box_low[k] = -kGridMargin;
        grid.box_high[k] = (1 << 24) + kGridMargin;
        grid.bins[k] = per_axis;
    }
    grid.bins[3] = ((1 << 24) + 2 * kGridMargin + 1 + per_axis - 1) / per_axis;
    return grid;
}

double farthestCoordinate(const Mesh& mesh) {
    float reach = 0;
    for (const Float3& p : mesh.positions)
        for (float x : p)
            reach = std::max(reach, std::fabs(x));
    return reach;
}

Int3 snapToGrid(const EventGrid& grid, const Double3& position) {
    Int3 p;
    for (size_t k = 0; k < 3; k++)
        p[k] = static_cast<int32_t>(std::nearbyint(position[k] * grid.scale)) + kGridCenter;
    return p;
}

Double3 fromGrid(const EventGrid& grid, const Int3& position) {
    Double3 p;
    for (size_t k = 0; k < 3; k++)
        p[k] = static_cast<double>(position[k] - kGridCenter) * static_cast<double>(grid.step);
    return p;
}

namespace {

engine::Result<void> checkThickness(const EventGrid& grid) {
    for (size_t k = 0; k < 3; k++)
        if (grid.mesh_low[k] == grid.mesh_high[k])
            return engine::Error{engine::ErrorCode::BadInput, "the model is flat on the grid of the event, whose step is " +
                                                                  formatNumber(static_cast<double>(grid.step)) +
                                                                  "; give it a thickness, or leave out sites far away"};
    return {};
}

} // namespace

engine::Result<EventGrid> makeEventGrid(const Mesh& mesh, std::span<const Double3> sites, uint32_t site_count, bool crowded) {
    auto reach = farthestSite(sites, farthestCoordinate(mesh));
    if (!reach) return reach.error();
    EventGrid grid;
    int exponent = 0;
    std::frexp(kGridCenter / std::max(*reach, 1e-37), &exponent);
    exponent = std::clamp(exponent - 1, -100, 100);
    grid.scale = std::ldexp(1.0f, exponent);
    grid.step = std::ldexp(1.0f, -exponent);
    grid.solid_volume = measureMesh(mesh).volume * std::pow(static_cast<double>(grid.scale), 3);
    setBox(grid, mesh, sites);
    if (auto thick = checkThickness(grid); !thick) return thick.error();
    setBins(grid, site_count, crowded ? kLeastShare : sites.empty() ? filledShare(grid) : 1.0);
    if (!sites.empty()) {
        setBins(grid, site_count, occupiedShare(grid, sites));
        grid.fullest_bin = std::ranges::max(countInBins(grid, sites));
    }
    return grid;
}

} // namespace brittle
