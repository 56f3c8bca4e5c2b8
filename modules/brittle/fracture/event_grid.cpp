#include "modules/brittle/fracture/event_grid.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace brittle {
namespace {

constexpr double kSitesPerBin = 2.0;
constexpr double kMostRoom = 8;           // of columns, in volumes of the solid
constexpr int64_t kMostColumns = 1 << 20; // of the raster
constexpr double kLeastShare = 1.0 / 32;  // of the bins that sites fall into: finer ones are not made
constexpr double kFarthestSite = 256.0;   // in half diagonals of the mesh's box

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

double solidVolume(const Mesh& mesh) {
    double six_volumes = 0;
    for (const Index3& t : mesh.triangles) {
        const Float3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        six_volumes += static_cast<double>(a[0]) * (static_cast<double>(b[1]) * c[2] - static_cast<double>(b[2]) * c[1]) +
                       static_cast<double>(a[1]) * (static_cast<double>(b[2]) * c[0] - static_cast<double>(b[0]) * c[2]) +
                       static_cast<double>(a[2]) * (static_cast<double>(b[0]) * c[1] - static_cast<double>(b[1]) * c[0]);
    }
    return six_volumes / 6;
}

// Share of the box that the solid fills: where sites are placed inside, bins outside stay empty.
double filledShare(const Mesh& mesh, const EventGrid& grid) {
    double box = 1;
    for (size_t k = 0; k < 3; k++)
        box *= (grid.box_high[k] - grid.box_low[k] + 1.0) * static_cast<double>(grid.step);
    return std::clamp(solidVolume(mesh) / box, kLeastShare, 1.0);
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

// A triangle, or what is left of it between planes across the axes: at most two corners more for each pair.
class ConvexOutline {
public:
    bool empty() const { return count_ == 0; }
    void add(const Int3& p) { points_[count_++] = {double(p[0]), double(p[1]), double(p[2])}; }
    std::pair<double, double> range(size_t axis) const {
        std::pair<double, double> range = {points_[0][axis], points_[0][axis]};
        for (size_t k = 1; k < count_; k++)
            range = {std::min(range.first, points_[k][axis]), std::max(range.second, points_[k][axis])};
        return range;
    }
    ConvexOutline between(size_t axis, double low, double high) const { return below(axis, high, 1).below(axis, -low, -1); }

private:
    // The part where sign * p[axis] <= bound.
    ConvexOutline below(size_t axis, double bound, double sign) const {
        ConvexOutline part;
        for (size_t k = 0; k < count_; k++) {
            const Double3 &a = points_[k], &b = points_[(k + 1) % count_];
            const double ha = sign * a[axis] - bound, hb = sign * b[axis] - bound;
            if (ha <= 0) part.points_[part.count_++] = a;
            if ((ha <= 0) == (hb <= 0)) continue;
            const double t = ha / (ha - hb);
            part.points_[part.count_++] = {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
        }
        return part;
    }
    std::array<Double3, 8> points_{};
    size_t count_ = 0;
};

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
    // Calls visit(column, lowest z, highest z) for all columns that the triangle lies over, with what of it lies there, and a
    // step around it.
    template <class Visit>
    void cover(const Index3& triangle, Visit visit) const {
        ConvexOutline outline;
        for (uint32_t v : triangle)
            outline.add(snapVertex(grid, mesh.positions[v]));
        const auto [first_y, last_y] = indices(outline, 1);
        for (int32_t y = first_y; y <= last_y; y++) {
            const ConvexOutline row = first_y == last_y ? outline : slice(outline, 1, y);
            if (row.empty()) continue;
            const auto [first_x, last_x] = indices(row, 0);
            for (int32_t x = first_x; x <= last_x; x++) {
                const ConvexOutline part = first_x == last_x ? row : slice(row, 0, x);
                if (part.empty()) continue;
                const auto [low, high] = part.range(2);
                visit(static_cast<size_t>(y) * static_cast<size_t>(nx) + static_cast<size_t>(x),
                      static_cast<int32_t>(std::floor(low)) - 1, static_cast<int32_t>(std::ceil(high)) + 1);
            }
        }
    }
    // Of the columns that an outline meets along x or y.
    std::pair<int32_t, int32_t> indices(const ConvexOutline& outline, size_t axis) const {
        const auto [low, high] = outline.range(axis);
        const double from = grid.mesh_low[axis];
        const int32_t last = axis == 0 ? nx - 1 : ny - 1;
        return {std::clamp(static_cast<int32_t>((low - 1 - from) / edge), 0, last),
                std::clamp(static_cast<int32_t>((high + 1 - from) / edge), 0, last)};
    }
    ConvexOutline slice(const ConvexOutline& outline, size_t axis, int32_t index) const {
        const double low = static_cast<double>(grid.mesh_low[axis]) + static_cast<double>(index) * edge;
        return outline.between(axis, low - 1, low + edge + 1);
    }
    using Heights = std::vector<std::array<int32_t, 2>>; // of each column, lowest and highest z
    Heights heights() const {
        Heights spans(static_cast<size_t>(nx) * static_cast<size_t>(ny), {1 << 24, 0});
        for (const Index3& t : mesh.triangles)
            cover(t, [&](size_t c, int32_t low, int32_t high) {
                spans[c] = {std::min(spans[c][0], low), std::max(spans[c][1], high)};
            });
        return spans;
    }
    // Volume of the columns between their lowest and highest triangles, in cubed grid steps.
    double room() const {
        double spans = 0;
        for (const auto& [low, high] : heights())
            spans += std::max(0.0, high - low + 1.0);
        return spans * edge * edge;
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
    // Columns that hold little of the solid would have most samples rejected, of a thin plate at an angle nearly all.
    const double wanted = kMostRoom * solidVolume(raster.mesh) * std::pow(static_cast<double>(grid.scale), 3);
    while (raster.edge > 1 && int64_t{4} * raster.nx * raster.ny <= kMostColumns && raster.room() > wanted)
        raster.setEdge((raster.edge + 1) / 2);
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
    const Raster::Heights heights = raster.heights();
    for (const Index3& t : mesh.triangles)
        raster.cover(t, [&](size_t c, int32_t, int32_t) { columns.start[c + 1]++; });
    for (size_t c = 0; c < count; c++)
        columns.start[c + 1] += columns.start[c];
    columns.triangles.resize(columns.start[count]);
    std::vector<uint32_t> at(columns.start.begin(), columns.start.end() - 1);
    for (size_t t = 0; t < mesh.triangles.size(); t++)
        raster.cover(mesh.triangles[t],
                     [&](size_t c, int32_t, int32_t) { columns.triangles[at[c]++] = static_cast<uint32_t>(t); });
    for (size_t c = 0; c < count; c++) {
        if (columns.start[c + 1] == columns.start[c]) continue;
        columns.occupied.push_back(
            {static_cast<int32_t>(c) % raster.nx, static_cast<int32_t>(c) / raster.nx, heights[c][0], heights[c][1]});
        columns.tallest = std::max(columns.tallest, static_cast<uint32_t>(heights[c][1] - heights[c][0]));
    }
    return columns;
}

} // namespace brittle
