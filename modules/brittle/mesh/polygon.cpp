#include "modules/brittle/mesh/polygon.h"

#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <numeric>

namespace brittle {
namespace {

using Point2 = std::array<double, 2>;

// Twice the signed area, positive where a, b, c turn counter-clockwise.
double turn(const Point2& a, const Point2& b, const Point2& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Newell's normal: right for concave and for slightly bent outlines.
Double3 outlineNormal(std::span<const Double3> outline) {
    Double3 normal = {0, 0, 0};
    for (size_t k = 1; k + 1 < outline.size(); ++k)
        normal += cross(outline[k] - outline[0], outline[k + 1] - outline[0]);
    return normal;
}

// Drops the coordinate along which the polygon is thinnest; the others keep their bits. Counter-clockwise afterwards.
std::vector<Point2> flatten(std::span<const Double3> outline, const Double3& normal) {
    const auto wider = [](double a, double b) { return std::abs(a) < std::abs(b); };
    const auto drop = static_cast<size_t>(std::max_element(normal.begin(), normal.end(), wider) - normal.begin());
    size_t u = (drop + 1) % 3, v = (drop + 2) % 3;
    if (normal[drop] < 0) std::swap(u, v);
    std::vector<Point2> points;
    points.reserve(outline.size());
    for (const Double3& p : outline)
        points.push_back({p[u] - outline[0][u], p[v] - outline[0][v]});
    return points;
}

// Tests of a corner against an ear, for every corner of the outline. Honest outlines need a few thousand at the worst; one that
// is made to need the cube of its corners would take for hours.
constexpr uint64_t kMaxTestsPerCorner = 20'000;

// How choosy the clipper is. Flat ears (a corner on the straight line between its neighbors) and ears with a corner right on
// their border are left for when there is nothing better to cut.
enum class Pick { Clear, Anything };

// The outline as a ring of which ears are cut off until a triangle is left.
class EarClipper {
public:
    explicit EarClipper(std::vector<Point2> points);
    std::vector<Index3> run();

private:
    double turnAt(uint32_t k) const { return turn(points_[before_[k]], points_[k], points_[after_[k]]); }
    bool isEar(uint32_t k, Pick pick);
    bool isInEar(const Point2& p, const std::array<Point2, 3>& ear, double margin) const;
    bool clipNext(Pick pick);
    void clip(uint32_t k);

    std::vector<Point2> points_;
    std::vector<uint32_t> before_, after_;
    std::vector<uint32_t> reflex_; // the corners that may lie in an ear; also those that were clipped or straightened since
    std::vector<char> is_clipped_;
    std::vector<Index3> triangles_;
    double rounding_ = 0; // twice an area that is as good as none
    uint64_t tests_left_;
    uint32_t current_ = 1;
    size_t left_;
};

EarClipper::EarClipper(std::vector<Point2> points)
    : points_(std::move(points)), before_(points_.size()), after_(points_.size()), is_clipped_(points_.size(), 0),
      tests_left_(kMaxTestsPerCorner * points_.size()), left_(points_.size()) {
    const auto count = static_cast<uint32_t>(points_.size());
    double size = 0;
    for (uint32_t k = 0; k < count; ++k) {
        before_[k] = (k + count - 1) % count;
        after_[k] = (k + 1) % count;
        size = std::max({size, std::abs(points_[k][0]), std::abs(points_[k][1])});
    }
    rounding_ = 1e-14 * size * size;
    for (uint32_t k = 0; k < count; ++k)
        if (turnAt(k) < 0) reflex_.push_back(k);
}

std::vector<Index3> EarClipper::run() {
    while (left_ > 3)
        if (!clipNext(Pick::Clear) && !clipNext(Pick::Anything)) return {};
    if (turnAt(current_) < -rounding_) return {};
    triangles_.push_back({before_[current_], current_, after_[current_]});
    return std::move(triangles_);
}

bool EarClipper::clipNext(Pick pick) {
    for (size_t tried = 0; tried < left_; ++tried, current_ = after_[current_])
        if (isEar(current_, pick)) {
            clip(current_);
            return true;
        }
    return false;
}

bool EarClipper::isEar(uint32_t k, Pick pick) {
    const double margin = pick == Pick::Clear ? -rounding_ : rounding_;
    if (turnAt(k) <= -margin || tests_left_ < reflex_.size()) return false;
    tests_left_ -= reflex_.size();
    const std::array<Point2, 3> ear = {points_[before_[k]], points_[k], points_[after_[k]]};
    return std::none_of(reflex_.begin(), reflex_.end(), [&](uint32_t r) {
        return !is_clipped_[r] && r != before_[k] && r != k && r != after_[k] && isInEar(points_[r], ear, margin);
    });
}

// Corners that repeat a corner of the ear, as bridges to a hole have them, do not count.
bool EarClipper::isInEar(const Point2& p, const std::array<Point2, 3>& ear, double margin) const {
    if (p == ear[0] || p == ear[1] || p == ear[2]) return false;
    return turn(ear[0], ear[1], p) >= margin && turn(ear[1], ear[2], p) >= margin && turn(ear[2], ear[0], p) >= margin;
}

void EarClipper::clip(uint32_t k) {
    triangles_.push_back({before_[k], k, after_[k]});
    is_clipped_[k] = 1;
    after_[before_[k]] = after_[k];
    before_[after_[k]] = before_[k];
    current_ = after_[k];
    --left_;
}

std::vector<Index3> fan(size_t corners) {
    std::vector<Index3> triangles;
    for (uint32_t k = 1; k + 1 < corners; ++k)
        triangles.push_back({0, k, k + 1});
    return triangles;
}

} // namespace

std::vector<Index3> triangulatePolygon(std::span<const Double3> outline) {
    const Double3 normal = outlineNormal(outline);
    if (outline.size() == 3 || normal == Double3{0, 0, 0}) return fan(outline.size());
    return EarClipper(flatten(outline, normal)).run();
}

} // namespace brittle
