#include "tools/accuracy/fracture_truth.h"

#include "modules/brittle/mesh/vector_math.h"
#include "tests/reference/contract.h"
#include "tests/support/fragment_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace accuracy {

using reference::Point;
using reference::Polyhedron;
using reference::Triangle;
using reference::Triangles;
using reference::operator+, reference::operator-, reference::operator*;

namespace kinds {
const ErrorKind kVolume = {"volume", "volume of all fragments", "share of the model's", "the model's own, in double precision"};
const ErrorKind kArea = {"area", "outer area of all fragments", "share of the model's", "the model's own, in double precision"};
const ErrorKind kCellVolume = {"cell_volume", "volume of the worst cell", "share of a mean cell",
                               "brute force Voronoi cells in double precision, and the model cut into signed tetrahedra"};
const ErrorKind kCorners = {"corners", "corner furthest from where it should be (Hausdorff)", "share of the diagonal",
                            "brute force Voronoi cells in double precision"};
const ErrorKind kPromises = {"promises", "broken promises: open edges, unpaired cut triangles, fragments turned over or parted",
                             "per million cells", "the contract of fragments, checked in double precision"};
const ErrorKind kNeighbors = {"neighbors", "pairs of neighbors that differ", "per million cells",
                              "brute force Voronoi cells in double precision"};
const ErrorKind kTurned = {"turned", "cut faces that are turned over", "share of the cut area",
                           "closed form: a site lies behind every face of its cell, in double precision"};
} // namespace kinds

namespace {

constexpr double kNoArea = 1e-9;           // of the diagonal's square: faces as small are there or not by rounding alone
constexpr double kConvexSlack = 1e-7;      // of the diagonal: corners are floats
constexpr double kRounding = 1e-12;        // of sums in double precision, over some ten thousand triangles
constexpr double kTurnedByRounding = 1e-9; // slivers whose corners are floats face anywhere
constexpr double kMillion = 1e6;

bool isConvex(const Triangles& model, double diagonal) {
    return std::ranges::all_of(model, [&](const Triangle& face) {
        const Point across = reference::cross(face[1] - face[0], face[2] - face[0]);
        const double limit = kConvexSlack * diagonal * reference::length(across);
        return std::ranges::all_of(model, [&](const Triangle& t) { return reference::dot(across, t[0] - face[0]) <= limit; });
    });
}

Triangles outlineOf(const Polyhedron& solid) {
    Triangles triangles;
    for (const reference::PolyhedronFace& face : solid.faces)
        for (size_t k = 2; k < face.loop.size(); ++k)
            triangles.push_back({face.loop[0], face.loop[k - 1], face.loop[k]});
    return triangles;
}

double worstCellVolume(const FractureTruth& truth, const reference::FragmentFile& file) {
    std::vector<double> volumes(truth.volumes.size(), 0);
    for (const reference::Piece& piece : file.pieces) {
        Triangles surface = piece.outer;
        surface.insert(surface.end(), piece.inner.begin(), piece.inner.end());
        if (piece.cell < volumes.size()) volumes[piece.cell] += reference::volumeOf(surface);
    }
    double worst = 0;
    for (size_t k = 0; k < volumes.size(); ++k)
        worst = std::max(worst, std::fabs(volumes[k] - truth.volumes[k]));
    return worst * static_cast<double>(volumes.size()) / truth.volume;
}

double furthestFrom(const Triangles& surface, const std::set<Point>& corners) {
    double furthest = 0;
    for (const Point& p : corners) {
        double nearest = 1e300;
        for (const Triangle& t : surface)
            nearest = std::min(nearest, reference::distanceTo(t, p));
        furthest = std::max(furthest, nearest);
    }
    return furthest;
}

std::set<Point> cornersOf(const Triangles& triangles) {
    std::set<Point> corners;
    for (const Triangle& t : triangles)
        corners.insert(t.begin(), t.end());
    return corners;
}

// Both ways, of the surfaces of every cell; a cell that one of the two has not got is off by all of the diagonal.
double furthestCorner(const FractureTruth& truth, const reference::FragmentFile& file) {
    std::vector<Triangles> ours(truth.cells.size());
    for (const reference::Piece& piece : file.pieces)
        for (const Triangles* part : {&piece.outer, &piece.inner})
            for (const Triangle& t : *part)
                ours[piece.cell].push_back({piece.translation + t[0], piece.translation + t[1], piece.translation + t[2]});
    double furthest = 0;
    for (size_t k = 0; k < ours.size(); ++k) {
        const Triangles theirs = outlineOf(truth.cells[k]);
        if (ours[k].empty() != theirs.empty()) return 1;
        furthest = std::max({furthest, furthestFrom(theirs, cornersOf(ours[k])), furthestFrom(ours[k], cornersOf(theirs))});
    }
    return furthest / truth.diagonal;
}

using CellPair = std::pair<uint32_t, uint32_t>;

std::set<CellPair> wideEnough(const std::map<CellPair, double>& areas, double diagonal) {
    std::set<CellPair> pairs;
    for (const auto& [pair, area] : areas)
        if (area > kNoArea * diagonal * diagonal) pairs.insert(pair);
    return pairs;
}

// Cells that share a cut triangle, corner for corner.
std::set<CellPair> neighborsOf(const reference::FragmentFile& file, double diagonal) {
    std::map<std::array<Point, 3>, uint32_t> first;
    std::map<CellPair, double> areas;
    for (const reference::Piece& piece : file.pieces)
        for (const Triangle& t : piece.inner) {
            std::array<Point, 3> key = t;
            std::ranges::sort(key);
            const auto [entry, is_new] = first.try_emplace(key, piece.cell);
            if (!is_new && entry->second != piece.cell)
                areas[std::minmax(entry->second, piece.cell)] += reference::areaOf(Triangles{t});
        }
    return wideEnough(areas, diagonal);
}

std::set<CellPair> neighborsOf(const FractureTruth& truth) {
    std::map<CellPair, double> areas;
    for (uint32_t k = 0; k < truth.cells.size(); ++k)
        for (const reference::PolyhedronFace& face : truth.cells[k].faces)
            if (face.id < truth.cells.size()) areas[std::minmax(k, face.id)] = reference::areaOf(face);
    return wideEnough(areas, truth.diagonal);
}

double differingNeighbors(const FractureTruth& truth, const reference::FragmentFile& file) {
    const std::set<CellPair> ours = neighborsOf(file, truth.diagonal), theirs = neighborsOf(truth);
    std::vector<CellPair> differing;
    std::ranges::set_symmetric_difference(ours, theirs, std::back_inserter(differing));
    return static_cast<double>(differing.size());
}

// Of all cut triangles, the area of those that face their own site.
double turnedShare(const reference::FragmentFile& file) {
    double turned = 0, all = 0;
    for (const reference::Piece& piece : file.pieces)
        for (const Triangle& t : piece.inner) {
            const Point across = reference::cross(t[1] - t[0], t[2] - t[0]);
            all += reference::length(across);
            if (reference::dot(across, piece.translation + t[0] - piece.site) < 0) turned += reference::length(across);
        }
    return all > 0 ? turned / all : 0;
}

} // namespace

FractureTruth truthOf(const brittle::Mesh& mesh, std::span<const brittle::Double3> sites) {
    FractureTruth truth;
    truth.model = support::trianglesOf(mesh);
    truth.sites.assign(sites.begin(), sites.end());
    truth.volume = reference::volumeOf(truth.model);
    truth.diagonal = reference::boundsOf(truth.model).diagonal();
    truth.is_convex = isConvex(truth.model, truth.diagonal);
    if (truth.is_convex) {
        truth.cells = reference::cellsOfConvex(truth.sites, truth.model);
        for (const Polyhedron& cell : truth.cells)
            truth.volumes.push_back(reference::volumeOf(cell));
    } else {
        truth.cells = reference::voronoiCells(truth.sites, reference::boundsOf(truth.model));
        truth.volumes = reference::volumesWithin(truth.model, truth.cells);
    }
    const double sum = std::accumulate(truth.volumes.begin(), truth.volumes.end(), 0.0);
    truth.defect = std::max(std::fabs(sum - truth.volume) / truth.volume, kRounding);
    return truth;
}

std::vector<MeasuredError> errorsOf(const FractureTruth& truth, const brittle::FractureResult& result) {
    const reference::FragmentFile file = support::fragmentFile(result.fragments);
    reference::ContractLimits limits;
    limits.random_points = 50;
    limits.bisector_tests = 20'000'000;
    const auto cells = static_cast<double>(truth.cells.size());
    if (file.pieces.empty()) return {{kinds::kPromises.name, kMillion, kMillion / cells}};
    const reference::ContractReport report = reference::checkContract(file, truth.model, limits);
    std::vector<MeasuredError> errors = {
        {kinds::kPromises.name, static_cast<double>(report.brokenPromises()) * kMillion / cells, kMillion / cells},
        {kinds::kVolume.name, report.volume_error, kRounding},
        {kinds::kArea.name, report.area_error, kRounding},
        {kinds::kTurned.name, turnedShare(file), kTurnedByRounding},
        {kinds::kCellVolume.name, worstCellVolume(truth, file), truth.defect * cells},
    };
    if (!truth.is_convex) return errors;
    errors.push_back({kinds::kCorners.name, furthestCorner(truth, file), truth.defect});
    errors.push_back({kinds::kNeighbors.name, differingNeighbors(truth, file) * kMillion / cells, kMillion / cells});
    return errors;
}

} // namespace accuracy
