#include "tools/bench/peers.h"

#ifdef BRITTLE_PEER_VOROPP

#include <voro++.hh>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

namespace bench {
namespace {

// As many blocks as Voro++'s own pre_container would take for this many sites in a unit box.
std::unique_ptr<voro::container> filledContainer(std::span<const Point> sites) {
    const double blocks = std::cbrt(static_cast<double>(sites.size()) / voro::optimal_particles);
    const int n = std::max(1, static_cast<int>(blocks) + 1);
    auto container = std::make_unique<voro::container>(0, 1, 0, 1, 0, 1, n, n, n, false, false, false, 8);
    for (size_t k = 0; k < sites.size(); ++k)
        container->put(static_cast<int>(k), sites[k][0], sites[k][1], sites[k][2]);
    return container;
}

} // namespace

std::optional<PeerCells> voroppCells(std::span<const Point> sites) {
    const auto begin = std::chrono::steady_clock::now();
    PeerCells result;
    const auto container = filledContainer(sites);
    voro::c_loop_all loop(*container);
    voro::voronoicell_neighbor cell;
    std::vector<int> neighbors;
    if (loop.start()) do {
            if (!container->compute_cell(cell, loop)) continue;
            cell.neighbors(neighbors);
            ++result.cells;
            result.faces += neighbors.size();
        } while (loop.inc());
    result.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    return result;
}

std::vector<std::vector<Point>> cellCorners(std::span<const Point> sites) {
    std::vector<std::vector<Point>> cells;
    const auto container = filledContainer(sites);
    voro::c_loop_all loop(*container);
    voro::voronoicell cell;
    if (loop.start()) do {
            if (!container->compute_cell(cell, loop)) continue;
            double x = 0, y = 0, z = 0;
            loop.pos(x, y, z);
            std::vector<double> numbers;
            cell.vertices(x, y, z, numbers);
            std::vector<Point>& corners = cells.emplace_back();
            for (size_t k = 0; k + 2 < numbers.size(); k += 3)
                corners.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
        } while (loop.inc());
    return cells;
}

} // namespace bench

#else

namespace bench {

std::optional<PeerCells> voroppCells(std::span<const Point>) { return std::nullopt; }
std::vector<std::vector<Point>> cellCorners(std::span<const Point>) { return {}; }

} // namespace bench

#endif
