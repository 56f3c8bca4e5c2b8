#include "tests/reference/contract.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <sstream>
#include <unordered_map>

namespace reference {
namespace {

using Indices = std::array<uint32_t, 3>;

struct PointHash {
    size_t operator()(const Point& p) const {
        size_t hash = 0;
        for (const double x : p)
            hash = hash * 0x9E3779B97F4A7C15u + std::hash<double>()(x); // hashes -0 and 0 alike
        return hash;
    }
};

// One number per position, over all fragments. Triangles with two equal corners enclose nothing and are left out.
class Welder {
public:
    std::vector<Indices> weld(const Triangles& triangles) {
        std::vector<Indices> welded;
        for (const Triangle& t : triangles) {
            const Indices i = {number(t[0]), number(t[1]), number(t[2])};
            if (i[0] != i[1] && i[1] != i[2] && i[2] != i[0]) welded.push_back(i);
        }
        return welded;
    }
    const Point& position(uint32_t number) const { return positions_[number]; }

private:
    uint32_t number(const Point& p) {
        const auto [entry, is_new] = numbers_.try_emplace(p, static_cast<uint32_t>(positions_.size()));
        if (is_new) positions_.push_back(p);
        return entry->second;
    }
    std::unordered_map<Point, uint32_t, PointHash> numbers_;
    std::vector<Point> positions_;
};

struct HalfEdge {
    uint32_t low, high;
    int direction; // +1 from low to high
    uint32_t triangle;
    bool sameEdge(const HalfEdge& other) const { return low == other.low && high == other.high; }
    bool operator<(const HalfEdge& other) const { return low != other.low ? low < other.low : high < other.high; }
};

std::vector<HalfEdge> sortedHalfEdges(const std::vector<Indices>& triangles) {
    std::vector<HalfEdge> edges;
    for (uint32_t t = 0; t < triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t from = triangles[t][k], to = triangles[t][(k + 1) % 3];
            edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1, t});
        }
    std::sort(edges.begin(), edges.end());
    return edges;
}

uint64_t countOpenEdges(const std::vector<HalfEdge>& edges) {
    uint64_t open = 0;
    for (size_t first = 0, k = 0; first < edges.size(); first = k) {
        int balance = 0;
        for (; k < edges.size() && edges[k].sameEdge(edges[first]); ++k)
            balance += edges[k].direction;
        open += balance != 0;
    }
    return open;
}

// The parts that hang together by edges, each seen from its own first corner: what lies far off loses the digits of thin ones.
std::vector<Triangles> partsOf(const Welder& welder, const std::vector<Indices>& triangles,
                               const std::vector<HalfEdge>& edges) {
    std::vector<uint32_t> parent(triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](uint32_t t) {
        while (parent[t] != t)
            t = parent[t] = parent[parent[t]];
        return t;
    };
    for (size_t k = 1; k < edges.size(); ++k)
        if (edges[k].sameEdge(edges[k - 1])) parent[root(edges[k].triangle)] = root(edges[k - 1].triangle);
    std::map<uint32_t, Triangles> by_root;
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        const Point origin = welder.position(triangles[root(t)][0]);
        Triangle& triangle = by_root[root(t)].emplace_back();
        for (size_t k = 0; k < 3; ++k)
            triangle[k] = welder.position(triangles[t][k]) - origin;
    }
    std::vector<Triangles> parts;
    parts.reserve(by_root.size());
    for (auto& [ignored, part] : by_root)
        parts.push_back(std::move(part));
    return parts;
}

// Whether one part is a solid and all others are walls of cavities. Those of a cavity that has collapsed may have passed
// through each other.
bool isOneSolid(const std::vector<Triangles>& parts, double collapsed) {
    const auto volumeIsLess = [](const Triangles& a, const Triangles& b) { return volumeOf(a) < volumeOf(b); };
    const auto solid = std::max_element(parts.begin(), parts.end(), volumeIsLess);
    if (solid == parts.end() || volumeOf(*solid) <= 0) return false;
    return std::all_of(parts.begin(), parts.end(), [&](const Triangles& part) {
        return &part == &*solid || volumeOf(part) <= collapsed * areaOf(part) / 2;
    });
}

struct InnerTriangle {
    Indices corners; // ascending
    int turn;        // +1 or -1: which way round they are walked
    uint32_t fragment;
    bool operator<(const InnerTriangle& other) const { return corners < other.corners; }
};

InnerTriangle innerTriangle(Indices i, uint32_t fragment) {
    int turn = 1;
    for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {0, 1}})
        if (i[size_t(a)] > i[size_t(b)]) {
            std::swap(i[size_t(a)], i[size_t(b)]);
            turn = -turn;
        }
    return {i, turn, fragment};
}

uint64_t countUnpaired(std::vector<InnerTriangle> triangles) {
    std::sort(triangles.begin(), triangles.end());
    uint64_t unpaired = 0;
    for (size_t first = 0, k = 0; first < triangles.size(); first = k) {
        std::map<uint32_t, int> by_fragment; // a fragment's own triangles must not pair up with each other
        int balance = 0;
        for (; k < triangles.size() && triangles[k].corners == triangles[first].corners; ++k) {
            balance += triangles[k].turn;
            by_fragment[triangles[k].fragment] += triangles[k].turn;
        }
        size_t one_sided = 0;
        for (const auto& [ignored, sum] : by_fragment)
            one_sided += static_cast<size_t>(std::abs(sum));
        unpaired += static_cast<uint64_t>(std::abs(balance)) + (k - first - one_sided);
    }
    return unpaired;
}

Triangles joined(const Triangles& a, const Triangles& b) {
    Triangles all = a;
    all.insert(all.end(), b.begin(), b.end());
    return all;
}

class Checker {
public:
    Checker(const FragmentFile& file, const Triangles& model, const ContractLimits& limits);
    ContractReport run();

private:
    void checkFrames();
    void checkSurfaces();
    void checkMeasures();
    void checkCells();
    void checkPoints();
    void testPoint(const Point& p);
    std::vector<Point> testPoints() const;
    void judge();

    const FragmentFile& file_;
    const ContractLimits& limits_;
    Triangles model_; // in the fragments' frame from here on
    Bounds bounds_;
    std::vector<Triangles> surfaces_;
    std::vector<Bounds> surface_bounds_;
    std::vector<Point> sites_; // of the fragments
    ContractReport report_;
};

Checker::Checker(const FragmentFile& file, const Triangles& model, const ContractLimits& limits)
    : file_(file), limits_(limits), model_(model) {
    const Point frame = file.pieces.front().translation;
    for (Triangle& t : model_)
        for (Point& p : t)
            p = p - frame;
    bounds_ = boundsOf(model_);
    for (const Piece& piece : file.pieces) {
        surfaces_.push_back(joined(piece.outer, piece.inner));
        surface_bounds_.push_back(boundsOf(surfaces_.back()));
        sites_.push_back(piece.site - frame);
    }
}

ContractReport Checker::run() {
    checkFrames();
    checkSurfaces();
    checkMeasures();
    checkCells();
    checkPoints();
    judge();
    return report_;
}

void Checker::checkFrames() {
    std::map<uint32_t, Point> site_of_cell;
    for (const Piece& piece : file_.pieces) {
        report_.mixed_frames += piece.translation != file_.pieces.front().translation;
        report_.mixed_sites += site_of_cell.try_emplace(piece.cell, piece.site).first->second != piece.site;
    }
}

void Checker::checkSurfaces() {
    Welder welder;
    std::vector<InnerTriangle> inner;
    for (uint32_t f = 0; f < surfaces_.size(); ++f) {
        for (const Indices& i : welder.weld(file_.pieces[f].inner))
            inner.push_back(innerTriangle(i, f));
        const std::vector<Indices> triangles = welder.weld(surfaces_[f]);
        const std::vector<HalfEdge> edges = sortedHalfEdges(triangles);
        report_.open_edges += countOpenEdges(edges);
        report_.not_connected += isOneSolid(partsOf(welder, triangles, edges), limits_.collapsed * bounds_.diagonal()) ? 0 : 1;
    }
    report_.unpaired_inner = countUnpaired(std::move(inner));
}

void Checker::checkMeasures() {
    const double model_volume = volumeOf(model_), model_area = areaOf(model_);
    double volume = 0, area = 0;
    Point moment = {0, 0, 0};
    for (size_t f = 0; f < surfaces_.size(); ++f) {
        const double v = volumeOf(surfaces_[f]);
        report_.not_positive += !(v > 0);
        report_.claimed_volume_off += !(std::abs(v - file_.pieces[f].volume) <= 1e-6 * model_volume);
        if (v > 0) moment = moment + v * (centroidOf(surfaces_[f]) - bounds_.center());
        volume += v;
        area += areaOf(file_.pieces[f].outer);
    }
    report_.volume_error = std::abs(volume - model_volume) / model_volume;
    report_.area_error = std::abs(area - model_area) / model_area;
    const Point offset = 1 / model_volume * moment - (centroidOf(model_) - bounds_.center());
    report_.centroid_error = length(offset) / bounds_.diagonal();
}

void Checker::checkCells() {
    uint64_t corners = 0;
    for (const Triangles& surface : surfaces_)
        corners += 3 * surface.size();
    const uint64_t stride = 1 + corners * sites_.size() / limits_.bisector_tests;
    uint64_t corner = 0;
    double furthest = 0;
    for (uint32_t f = 0; f < surfaces_.size(); ++f)
        for (const Triangle& t : surfaces_[f])
            for (const Point& p : t)
                if (corner++ % stride == 0) furthest = std::max(furthest, distanceOutsideCell(sites_, f, p));
    report_.outside_cell = furthest / bounds_.diagonal();
}

// Anywhere in the box, and just off the faces of fragments: that is where a missing sliver or an overlap would be.
std::vector<Point> Checker::testPoints() const {
    std::mt19937_64 random(limits_.seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Point> points;
    for (uint32_t k = 0; k < limits_.random_points; ++k) {
        Point p;
        for (size_t c = 0; c < 3; ++c)
            p[c] = bounds_.lower[c] + unit(random) * (bounds_.upper[c] - bounds_.lower[c]);
        points.push_back(p);
        const Triangles& surface = surfaces_[random() % surfaces_.size()];
        if (surface.empty()) continue;
        const Triangle& t = surface[random() % surface.size()];
        const double u = unit(random), v = unit(random) * (1 - u);
        p = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
        for (size_t c = 0; c < 3; ++c)
            p[c] += (unit(random) - .5) * 2e-3 * bounds_.diagonal();
        points.push_back(p);
    }
    return points;
}

void Checker::checkPoints() {
    for (const Point& p : testPoints())
        testPoint(p);
}

void Checker::testPoint(const Point& p) {
    const long double winding = windingNumber(model_, p);
    const bool solid = std::round(winding) == 1;
    if (std::abs(winding - std::round(winding)) > 1e-3L) return; // on the surface
    std::vector<uint32_t> holders;
    for (uint32_t f = 0; f < surfaces_.size(); ++f) {
        if (!surface_bounds_[f].holds(p, 1e-9 * bounds_.diagonal())) continue;
        const long double within = windingNumber(surfaces_[f], p);
        if (std::abs(within - std::round(within)) > 1e-3L) return; // on a cut
        if (std::round(within) != 0) holders.push_back(f);
    }
    ++report_.points_tested;
    if (holders.size() != (solid ? 1u : 0u))
        ++report_.points_wrong;
    else if (solid && distanceOutsideCell(sites_, holders.front(), p) > limits_.outside_cell * bounds_.diagonal())
        ++report_.points_misplaced;
}

void Checker::judge() {
    ContractReport& r = report_;
    const auto limit = [&](double value, double allowed, const char* what) {
        std::ostringstream line;
        line << what << ": " << value;
        if (allowed > 0) line << " (allowed " << allowed << ")";
        if (!(value <= allowed)) r.problems.push_back(line.str());
    };
    r.problems = file_.faults;
    limit(static_cast<double>(r.open_edges), 0, "open edges");
    limit(static_cast<double>(r.unpaired_inner), 0, "unpaired inner triangles");
    limit(r.volume_error, limits_.volume_error, "volume error");
    limit(r.area_error, limits_.area_error, "area error");
    limit(r.centroid_error, limits_.volume_error, "centroid error");
    limit(r.not_positive, 0, "fragments without positive volume");
    limit(r.claimed_volume_off, 0, "fragments whose stated volume is not theirs");
    limit(r.not_connected, 0, "fragments that are not one connected solid");
    limit(r.outside_cell, limits_.outside_cell, "vertex outside its cell, share of the diagonal");
    limit(r.mixed_frames, 0, "fragments with a translation of their own");
    limit(r.mixed_sites, 0, "fragments whose cell has another site elsewhere");
    limit(r.points_wrong, 0, "points in the wrong number of fragments");
    limit(r.points_misplaced, 0, "points in a fragment of another cell");
}

} // namespace

std::string ContractReport::text() const {
    std::ostringstream out;
    out << "volume error " << volume_error << ", area error " << area_error << ", outside cell " << outside_cell << ", "
        << points_tested << " points";
    for (const std::string& problem : problems)
        out << "\n  " << problem;
    return out.str();
}

ContractReport checkContract(const FragmentFile& file, const Triangles& model, const ContractLimits& limits) {
    return Checker(file, model, limits).run();
}

} // namespace reference
