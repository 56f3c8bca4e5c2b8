#include "modules/brittle/fracture/event_grid.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace brittle {
namespace {

constexpr double kSitesPerBin = 2.0;
constexpr double kLeastShare = 1.0 / 32; // of the bins that sites fall into: finer ones are not made
constexpr double kFarthestSite = 256.0;  // in half diagonals of the mesh's box

Int3 snapVertex(const EventGrid& grid, const Float3& p) { return snapToGrid(grid, {p[0], p[1], p[2]}); }

double farthestCoordinate(const Mesh& mesh) {
    float reach = 0;
    for (const Float3& p : mesh.positions)
        for (float x : p)
            reach = std::max(reach, std::fabs(x));
    return reach;
}

engine::Result<double> farthestSite(std::span<const Double3> sites, double mesh_reach) {
    double reach = mesh_reach;
    for (size_t k = 0; k < sites.size(); k++) {
        for (double x : sites[k]) {
            if (!std::isfinite(x) || std::fabs(x) > kFarthestSite * mesh_reach)
                return engine::Error{engine::ErrorCode::BadInput,
                                     "site " + std::to_string(k) + " is not finite or lies more than " +
                                         std::to_string(static_cast<int>(kFarthestSite)) +
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
double filledShare(const Mesh& mesh, const EventGrid& grid) {
    double six_volumes = 0, box = 1;
    for (const Index3& t : mesh.triangles) {
        const Float3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        six_volumes += static_cast<double>(a[0]) * (static_cast<double>(b[1]) * c[2] - static_cast<double>(b[2]) * c[1]) +
                       static_cast<double>(a[1]) * (static_cast<double>(b[2]) * c[0] - static_cast<double>(b[0]) * c[2]) +
                       static_cast<double>(a[2]) * (static_cast<double>(b[0]) * c[1] - static_cast<double>(b[1]) * c[0]);
    }
    for (size_t k = 0; k < 3; k++)
        box *= (grid.box_high[k] - grid.box_low[k] + 1.0) * static_cast<double>(grid.step);
    return std::clamp(six_volumes / 6 / box, kLeastShare, 1.0);
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

engine::Result<EventGrid> makeEventGrid(const Mesh& mesh, std::span<const Double3> sites, uint32_t site_count, bool crowded) {
    auto reach = farthestSite(sites, farthestCoordinate(mesh));
    if (!reach) return reach.error();
    EventGrid grid;
    int exponent = 0;
    std::frexp((kGridCenter - 2 * kGridMargin) / std::max(*reach, 1e-37), &exponent);
    exponent = std::clamp(exponent - 1, -100, 100);
    grid.scale = std::ldexp(1.0f, exponent);
    grid.step = std::ldexp(1.0f, -exponent);
    setBox(grid, mesh, sites);
    setBins(grid, site_count, crowded ? kLeastShare : sites.empty() ? filledShare(mesh, grid) : 1.0);
    if (!sites.empty()) {
        setBins(grid, site_count, occupiedShare(grid, sites));
        grid.fullest_bin = std::ranges::max(countInBins(grid, sites));
    }
    return grid;
}

namespace {

struct Raster {
    const Mesh& mesh;
    const EventGrid& grid;
    int32_t edge = 1;
    int32_t nx = 1, ny = 1;

    void setEdge(int32_t length) {
        edge = length;
        nx = (grid.mesh_high[0] - grid.mesh_low[0]) / edge + 1;
        ny = (grid.mesh_high[1] - grid.mesh_low[1]) / edge + 1;
    }
    // Calls visit(column, lowest z, highest z) for all columns under the triangle's box.
    template <class Visit>
    void cover(const Index3& triangle, Visit visit) const {
        Int3 low = {1 << 24, 1 << 24, 1 << 24}, high = {0, 0, 0};
        for (uint32_t v : triangle) {
            Int3 p = snapVertex(grid, mesh.positions[v]);
            for (size_t k = 0; k < 3; k++) {
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
        }
        for (int32_t y = (low[1] - grid.mesh_low[1]) / edge; y <= (high[1] - grid.mesh_low[1]) / edge; y++)
            for (int32_t x = (low[0] - grid.mesh_low[0]) / edge; x <= (high[0] - grid.mesh_low[0]) / edge; x++)
                visit(static_cast<size_t>(y) * static_cast<size_t>(nx) + static_cast<size_t>(x), low[2], high[2]);
    }
    uint64_t entries() const {
        uint64_t total = 0;
        for (const Index3& t : mesh.triangles)
            cover(t, [&](size_t, int32_t, int32_t) { total++; });
        return total;
    }
};

void chooseEdge(Raster& raster) {
    const EventGrid& grid = raster.grid;
    double wide = grid.mesh_high[0] - grid.mesh_low[0] + 1.0, deep = grid.mesh_high[1] - grid.mesh_low[1] + 1.0;
    double per_column = std::sqrt(wide * deep / std::max<double>(1.0, static_cast<double>(raster.mesh.triangles.size()) / 2));
    double least = std::max(wide, deep) / 1024;
    raster.setEdge(static_cast<int32_t>(std::ceil(std::max({1.0, per_column, least}))));
    // Long triangles lie under many columns; coarser ones keep the lists short.
    while (raster.nx * raster.ny > 1 && raster.entries() > 8 * raster.mesh.triangles.size())
        raster.setEdge(raster.edge * 2);
}

} // namespace

TriangleColumns makeColumns(const Mesh& mesh, const EventGrid& grid) {
    Raster raster{mesh, grid};
    chooseEdge(raster);
    auto count = static_cast<size_t>(raster.nx) * static_cast<size_t>(raster.ny);
    TriangleColumns columns;
    columns.edge = raster.edge;
    columns.per_row = raster.nx;
    columns.start.assign(count + 1, 0);
    std::vector<std::array<int32_t, 2>> heights(count, {1 << 24, 0});
    for (const Index3& t : mesh.triangles)
        raster.cover(t, [&](size_t c, int32_t low, int32_t high) {
            columns.start[c + 1]++;
            heights[c] = {std::min(heights[c][0], low), std::max(heights[c][1], high)};
        });
    for (size_t c = 0; c < count; c++)
        columns.start[c + 1] += columns.start[c];
    columns.triangles.resize(columns.start[count]);
    std::vector<uint32_t> at(columns.start.begin(), columns.start.end() - 1);
    for (size_t t = 0; t < mesh.triangles.size(); t++)
        raster.cover(mesh.triangles[t],
                     [&](size_t c, int32_t, int32_t) { columns.triangles[at[c]++] = static_cast<uint32_t>(t); });
    for (size_t c = 0; c < count; c++)
        if (columns.start[c + 1] > columns.start[c])
            columns.occupied.push_back(
                {static_cast<int32_t>(c) % raster.nx, static_cast<int32_t>(c) / raster.nx, heights[c][0], heights[c][1]});
    return columns;
}

} // namespace brittle
