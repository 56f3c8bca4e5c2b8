#include "modules/brittle/scene/hull/hull_points.h"

#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/hull/convex_hull.h"

#include <algorithm>
#include <unordered_map>

namespace brittle {
namespace {

// Beyond this a float, which bodies are made of, cannot tell the places in a hull from each other.
constexpr double kLargestHull = 1e10;

engine::Error refuse(const std::string& reason) { return {engine::ErrorCode::BadInput, reason}; }

// A grid of cells two tolerances wide: whatever is nearer to a point than the tolerance lies in one of the eight cells about
// the corner of cells that the point is nearest to.
class NearPoints {
public:
    NearPoints(const Double3& origin, double tolerance) : origin_(origin), tolerance_(tolerance) {}

    // Whether a point that was added before is nearer than the tolerance; adds it if not.
    bool joins(const Double3& p, const std::vector<Double3>& points) {
        for (uint32_t neighbor = 0; neighbor < 8; ++neighbor) {
            const auto [first, last] = cells_.equal_range(keyOf(p, neighbor));
            for (auto entry = first; entry != last; ++entry)
                if (length(points[entry->second] - p) <= tolerance_) return true;
        }
        const std::array<int64_t, 3> own = cellOf(p);
        cells_.emplace(keyOf(own), static_cast<uint32_t>(points.size()));
        return false;
    }

private:
    double inCells(double coordinate, double origin) const { return (coordinate - origin) / (2 * tolerance_); }
    std::array<int64_t, 3> cellOf(const Double3& p) const {
        std::array<int64_t, 3> cell;
        for (size_t c = 0; c < 3; ++c)
            cell[c] = static_cast<int64_t>(std::floor(inCells(p[c], origin_[c])));
        return cell;
    }
    uint64_t keyOf(const Double3& p, uint32_t neighbor) const {
        std::array<int64_t, 3> cell;
        for (size_t c = 0; c < 3; ++c)
            cell[c] = static_cast<int64_t>(std::floor(inCells(p[c], origin_[c]) - 0.5)) + (neighbor >> c & 1);
        return keyOf(cell);
    }
    // Of different cells it may be the same one: what lies in it is looked at anyway.
    static uint64_t keyOf(const std::array<int64_t, 3>& cell) {
        uint64_t key = 0;
        for (const int64_t c : cell)
            key = (key ^ static_cast<uint64_t>(c)) * 0x9E3779B97F4A7C15u + (key >> 31);
        return key;
    }

    Double3 origin_;
    double tolerance_;
    std::unordered_multimap<uint64_t, uint32_t> cells_;
};

template <class Distance>
double furthest(const std::vector<Double3>& points, const Distance& distance, Double3& where) {
    double most = -1;
    for (const Double3& p : points)
        if (const double d = distance(p); d > most) {
            most = d;
            where = p;
        }
    return most;
}

// Whether four of the points span a solid, found greedily: the furthest from a point, from a line, from a plane.
engine::Result<void> checkSpan(const CleanPoints& clean) {
    const double flat = kHullTolerance * clean.size;
    const std::vector<Double3>& points = clean.points;
    Double3 a = points[0], b = a, c = a, d = a;
    furthest(
        points, [&](const Double3& p) { return length(p - clean.middle); }, a);
    furthest(
        points, [&](const Double3& p) { return length(p - a); }, b);
    const Double3 along = normalized(b - a, {1, 0, 0});
    const double width = furthest(
        points, [&](const Double3& p) { return length(cross(along, p - a)); }, c);
    if (width <= flat)
        return refuse("collinear points: all lie within " + formatNumber(flat) +
                      " m of one line; give points that span a solid");
    const Double3 normal = normalized(cross(along, c - a), {0, 0, 1});
    const double thickness = furthest(
        points, [&](const Double3& p) { return std::fabs(dot(normal, p - a)); }, d);
    if (thickness <= flat)
        return refuse("coplanar points: all lie within " + formatNumber(flat) +
                      " m of one plane; give the body a thickness (a thin box is one)");
    return {};
}

} // namespace

engine::Result<CleanPoints> cleanPoints(std::span<const Double3> points) {
    Box box;
    for (size_t k = 0; k < points.size(); ++k) {
        if (!isFinite(points[k]))
            return refuse("not finite: point " + std::to_string(k) + " holds a coordinate that is no number");
        box.grow(points[k]);
    }
    if (points.size() < 4)
        return refuse("too few points: " + std::to_string(points.size()) + " of at least 4 that a solid needs");
    CleanPoints clean;
    clean.size = box.diagonal();
    if (!(clean.size <= kLargestHull))
        return refuse("too large: " + formatNumber(clean.size) + " m across; models are in meters");
    clean.middle = 0.5 * (box.lower + box.upper);
    // Coordinates far from the origin are no finer than this, whatever the size.
    const double rounding = 4e-16 * std::max(length(box.lower), length(box.upper));
    if (!(kHullTolerance * clean.size > rounding))
        return refuse("coincident points: all of them lie in one place; give points that span a solid");
    NearPoints near(box.lower, kHullTolerance * clean.size);
    for (const Double3& p : points)
        if (near.joins(p, clean.points))
            ++clean.joined;
        else
            clean.points.push_back(p);
    if (clean.points.size() < 4)
        return refuse("too few points: " + std::to_string(clean.points.size()) + " of at least 4, after joining " +
                      std::to_string(clean.joined) + " that lie where others do");
    if (auto spans = checkSpan(clean); !spans) return spans.error();
    return clean;
}

} // namespace brittle
