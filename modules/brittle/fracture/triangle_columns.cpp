#include "modules/brittle/fracture/triangle_columns.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace brittle {
namespace {

constexpr double kMostRoom = 8;              // of columns, in volumes of the solid, where finer ones could have less
constexpr double kWorthwhile = 0.75;         // of the room, what columns of half the edge may at most have
constexpr int64_t kMostColumns = 1 << 20;    // of the raster
constexpr uint64_t kEntriesATriangle = 8;    // of the lists, for many triangles
constexpr uint64_t kEntriesAnyway = 1 << 18; // and for few
constexpr int64_t kFewColumns = 16;          // under a triangle's box, where its shape is not looked at

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

using Range = std::pair<int32_t, int32_t>; // first and last

// Columns of one size over the mesh's box.
struct Raster {
    Int3 origin;
    int32_t edge, nx, ny;
    int64_t few_columns;

    Raster(const EventGrid& of, int32_t length, int64_t few = kFewColumns)
        : origin(of.mesh_low), edge(length), nx((of.mesh_high[0] - of.mesh_low[0]) / length + 1),
          ny((of.mesh_high[1] - of.mesh_low[1]) / length + 1), few_columns(few) {}

    int64_t columns() const { return int64_t{nx} * ny; }
    size_t columnOf(int32_t x, int32_t y) const {
        return static_cast<size_t>(y) * static_cast<size_t>(nx) + static_cast<size_t>(x);
    }
    // Calls visit(column, lowest z, highest z) for all columns that the triangle lies over, and maybe for some beside it.
    template <class Visit>
    void cover(const std::array<Int3, 3>& corners, Visit visit) const {
        const auto [x0, x1] = columnsAlong(corners, 0);
        const auto [y0, y1] = columnsAlong(corners, 1);
        if (int64_t{x1 - x0 + 1} * (y1 - y0 + 1) > few_columns) return coverOutline(corners, {y0, y1}, visit);
        const auto [low, high] = spanOf(corners, 2);
        for (int32_t y = y0; y <= y1; y++)
            for (int32_t x = x0; x <= x1; x++)
                visit(columnOf(x, y), low, high);
    }

private:
    static Range spanOf(const std::array<Int3, 3>& corners, size_t axis) {
        return std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
    }
    Range columnsAlong(const std::array<Int3, 3>& corners, size_t axis) const {
        const auto [low, high] = spanOf(corners, axis);
        return {(low - origin[axis]) / edge, (high - origin[axis]) / edge};
    }
    // With what of the triangle lies over each column, and a step around it, since the cuts are rounded.
    template <class Visit>
    void coverOutline(const std::array<Int3, 3>& corners, Range rows, Visit visit) const {
        ConvexOutline outline;
        for (const Int3& p : corners)
            outline.add(p);
        for (int32_t y = rows.first; y <= rows.second; y++) {
            const ConvexOutline row = slice(outline, 1, y);
            if (row.empty()) continue;
            const auto [first, last] = columnsAlong(row);
            for (int32_t x = first; x <= last; x++) {
                const ConvexOutline part = slice(row, 0, x);
                if (part.empty()) continue;
                const auto [low, high] = part.range(2);
                visit(columnOf(x, y), static_cast<int32_t>(std::floor(low)) - 1, static_cast<int32_t>(std::ceil(high)) + 1);
            }
        }
    }
    Range columnsAlong(const ConvexOutline& row) const {
        const auto [low, high] = row.range(0);
        return {std::clamp(static_cast<int32_t>((low - 1 - origin[0]) / edge), 0, nx - 1),
                std::clamp(static_cast<int32_t>((high + 1 - origin[0]) / edge), 0, nx - 1)};
    }
    ConvexOutline slice(const ConvexOutline& outline, size_t axis, int32_t index) const {
        const double low = static_cast<double>(origin[axis]) + static_cast<double>(index) * edge;
        return outline.between(axis, low - 1, low + edge + 1);
    }
};

using Corners = std::vector<std::array<Int3, 3>>; // of each triangle, on the grid

Corners snapTriangles(const Mesh& mesh, const EventGrid& grid) {
    std::vector<Int3> snapped;
    snapped.reserve(mesh.positions.size());
    for (const Float3& p : mesh.positions)
        snapped.push_back(snapToGrid(grid, {p[0], p[1], p[2]}));
    Corners corners;
    corners.reserve(mesh.triangles.size());
    for (const Index3& t : mesh.triangles)
        corners.push_back({snapped[t[0]], snapped[t[1]], snapped[t[2]]});
    return corners;
}

// What one pass over the triangles tells of a raster. It is given up where the lists would get longer than `most`.
struct Survey {
    Raster raster;
    std::vector<std::array<int32_t, 2>> heights; // of each column, lowest and highest z
    std::vector<uint32_t> counts;                // of each column, its triangles
    uint64_t entries = 0;
    bool whole = true;

    Survey(const Corners& triangles, const Raster& over, uint64_t most)
        : raster(over), heights(static_cast<size_t>(over.columns()), {1 << 24, 0}),
          counts(static_cast<size_t>(over.columns()), 0) {
        for (const auto& corners : triangles) {
            raster.cover(corners, [&](size_t c, int32_t low, int32_t high) {
                heights[c] = {std::min(heights[c][0], low), std::max(heights[c][1], high)};
                counts[c]++;
                entries++;
            });
            whole = entries <= most;
            if (!whole) break;
        }
    }
    // Volume of the columns between their lowest and highest triangles, in cubed grid steps.
    double room() const {
        double spans = 0;
        for (const auto& [low, high] : heights)
            spans += std::max(0.0, high - low + 1.0);
        return spans * raster.edge * raster.edge;
    }
};

int32_t usualEdge(const EventGrid& grid, size_t triangles) {
    const double wide = grid.mesh_high[0] - grid.mesh_low[0] + 1.0, deep = grid.mesh_high[1] - grid.mesh_low[1] + 1.0;
    const double per_column = std::sqrt(wide * deep / std::max(1.0, static_cast<double>(triangles) / 2));
    return static_cast<int32_t>(std::ceil(std::max({1.0, per_column, std::max(wide, deep) / 1024})));
}

// Long triangles lie over many columns; coarser ones keep the lists short.
Survey coarseEnough(const Corners& triangles, const EventGrid& grid) {
    int32_t edge = usualEdge(grid, triangles.size());
    const uint64_t most = kEntriesATriangle * triangles.size();
    while (true) {
        const Raster raster(grid, edge);
        Survey survey(triangles, raster, raster.columns() > 1 ? most : ~0ull);
        if (survey.whole) return survey;
        edge *= 2;
    }
}

Survey fineEnough(const Corners& triangles, const EventGrid& grid, Survey survey) {
    const double wanted = kMostRoom * grid.solid_volume;
    const uint64_t most = std::max(kEntriesATriangle * triangles.size(), kEntriesAnyway);
    double room = survey.room();
    while (survey.raster.edge > 1 && 4 * survey.raster.columns() <= kMostColumns && room > wanted) {
        Survey finer(triangles, Raster(grid, (survey.raster.edge + 1) / 2, 1), most); // every triangle as it lies
        if (!finer.whole || finer.room() > kWorthwhile * room) break;
        room = finer.room();
        survey = std::move(finer);
    }
    return survey;
}

void fillLists(TriangleColumns& columns, const Corners& triangles, const Survey& survey) {
    columns.start.assign(survey.counts.size() + 1, 0);
    for (size_t c = 0; c < survey.counts.size(); c++)
        columns.start[c + 1] = columns.start[c] + survey.counts[c];
    columns.triangles.resize(columns.start.back());
    std::vector<uint32_t> at(columns.start.begin(), columns.start.end() - 1);
    for (uint32_t t = 0; t < triangles.size(); t++)
        survey.raster.cover(triangles[t], [&](size_t c, int32_t, int32_t) { columns.triangles[at[c]++] = t; });
}

void listOccupied(TriangleColumns& columns, const Survey& survey) {
    const int32_t nx = survey.raster.nx;
    for (size_t c = 0; c < survey.counts.size(); c++) {
        if (survey.counts[c] == 0) continue;
        const auto [low, high] = survey.heights[c];
        columns.occupied.push_back({static_cast<int32_t>(c) % nx, static_cast<int32_t>(c) / nx, low, high});
        columns.tallest = std::max(columns.tallest, static_cast<uint32_t>(high - low));
    }
}

} // namespace

TriangleColumns makeColumns(const Mesh& mesh, const EventGrid& grid) {
    const Corners triangles = snapTriangles(mesh, grid);
    const Survey survey = fineEnough(triangles, grid, coarseEnough(triangles, grid));
    TriangleColumns columns;
    columns.edge = survey.raster.edge;
    columns.per_row = survey.raster.nx;
    fillLists(columns, triangles, survey);
    listOccupied(columns, survey);
    return columns;
}

} // namespace brittle
