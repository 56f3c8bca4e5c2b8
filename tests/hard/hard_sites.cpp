#include "tests/hard/hard_sites.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

namespace hard {
namespace {

using Points = std::vector<Point>;
using Random = std::mt19937_64;

constexpr Point kCenter = {.5, .5, .5};
constexpr uint32_t kUniformSeed = 12345;

Points uniformPoints(size_t count, uint32_t seed) {
    Random random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    Points points(count);
    for (Point& p : points)
        for (double& x : p)
            x = unit(random);
    return points;
}

// One site per offset in every cube of a side^3 grid; offsets and the result are in units of the box.
Points lattice(uint32_t side, const Points& offsets) {
    const double n = side;
    Points points;
    for (uint32_t i = 0; i < side; ++i)
        for (uint32_t j = 0; j < side; ++j)
            for (uint32_t k = 0; k < side; ++k)
                for (const Point& o : offsets)
                    points.push_back({(i + o[0]) / n, (j + o[1]) / n, (k + o[2]) / n});
    return points;
}

Points jittered(Points points, double amount, uint32_t seed) {
    Random random(seed);
    std::uniform_real_distribution<double> shift(-amount, amount);
    for (Point& p : points)
        for (double& x : p)
            x += shift(random);
    return points;
}

Points randomOnSphere(size_t count, double radius, uint32_t seed) {
    Random random(seed);
    std::normal_distribution<double> normal;
    Points points(count);
    for (Point& p : points) {
        for (double& x : p)
            x = normal(random);
        const double scale = radius / std::hypot(p[0], p[1], p[2]);
        for (double& x : p)
            x = .5 + x * scale;
    }
    return points;
}

Points circle(size_t count, double radius) {
    Points points;
    for (size_t k = 0; k < count; ++k) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
        points.push_back({.5 + radius * std::cos(angle), .5 + radius * std::sin(angle), .5});
    }
    return points;
}

// A golden spiral from pole to pole: as even as points on a sphere can simply be had.
Points spiralSphere(size_t count, double radius) {
    constexpr double kGoldenAngle = 2.399963229728653;
    Points points;
    for (size_t k = 0; k < count; ++k) {
        const double i = static_cast<double>(k), z = 1 - 2 * (i + .5) / static_cast<double>(count);
        const double across = radius * std::sqrt(1 - z * z), angle = i * kGoldenAngle;
        points.push_back({.5 + across * std::cos(angle), .5 + across * std::sin(angle), .5 + radius * z});
    }
    return points;
}

Points mapped(Points points, auto&& change) {
    for (size_t k = 0; k < points.size(); ++k)
        change(points[k], k);
    return points;
}

Points joined(Points first, const Points& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

// The first hundred points once more, each shifted along one axis; a shift out of the box is left out.
Points withNearDoubles(const Points& points, double shift) {
    Points doubles;
    for (size_t k = 0; k < 100; ++k) {
        Point p = points[k];
        p[k % 3] += shift;
        if (p[k % 3] < 1) doubles.push_back(p);
    }
    return joined(points, doubles);
}

// Shells of 20 sites, each shell half as wide as the one before.
Points graded(const Points& points, uint32_t shells) {
    Points result;
    for (uint32_t shell = 0; shell < shells; ++shell) {
        const double radius = .45 * std::pow(.5, shell);
        for (size_t i = 0; i < 20; ++i) {
            Point p = points[20 * shell % 980 + i];
            for (double& x : p)
                x = .5 + radius * (x - .5) * 2;
            result.push_back(p);
        }
    }
    return result;
}

void addLattices(std::vector<HardSites>& all) {
    constexpr double q = .25, h = .75;
    const Points cubic = {kCenter};
    all.push_back({"lattice, cubic, 16: every coordinate a binary fraction", {}, {1, 1, 1}, lattice(16, cubic)});
    all.push_back({"lattice, cubic, 13: coordinates rounded", {}, {1, 1, 1}, lattice(13, cubic)});
    all.push_back({"lattice, face-centered, 9", {}, {1, 1, 1}, lattice(9, {{q, q, q}, {h, h, q}, {h, q, h}, {q, h, h}})});
    all.push_back({"lattice, body-centered, 9", {}, {1, 1, 1}, lattice(9, {{q, q, q}, {h, h, h}})});
    all.push_back({"lattice, cubic, 9, jitter 1e-7", {}, {1, 1, 1}, jittered(lattice(9, cubic), 1e-7, 7)});
}

void addRoundShapes(std::vector<HardSites>& all) {
    const Points sphere = randomOnSphere(1000, .4, 3);
    all.push_back({"sphere of 1000 and its center", {}, {1, 1, 1}, joined({kCenter}, sphere)});
    all.push_back({"sphere of 1000", {}, {1, 1, 1}, sphere});
    all.push_back({"circle of 100 in a plane", {}, {1, 1, 1}, circle(100, .4)});
}

void addFlatAndDouble(std::vector<HardSites>& all, const Points& uniform) {
    all.push_back({"coplanar, 1000", {}, {1, 1, 1}, mapped(uniform, [](Point& p, size_t) { p[2] = .5; })});
    all.push_back({"collinear, 1000", {}, {1, 1, 1}, mapped(uniform, [](Point& p, size_t) { p[1] = p[2] = .5; })});
    all.push_back({"doubles, 100 of 1000", {}, {1, 1, 1}, withNearDoubles(uniform, 0)});
    all.push_back({"near doubles at 1e-6", {}, {1, 1, 1}, withNearDoubles(uniform, 1e-6)});
    all.push_back({"near doubles at 1e-9", {}, {1, 1, 1}, withNearDoubles(uniform, 1e-9)});
    all.push_back({"near doubles at 1e-12", {}, {1, 1, 1}, withNearDoubles(uniform, 1e-12)});
    all.push_back({"near doubles at 1e-15", {}, {1, 1, 1}, withNearDoubles(uniform, 1e-15)});
}

void addBoxBound(std::vector<HardSites>& all, const Points& uniform) {
    const auto to_face = [](Point& p, size_t k) { p[k % 3] = k % 2 == 1 ? 1.0 : 0.0; };
    all.push_back({"on the box's faces, 1000", {}, {1, 1, 1}, mapped(uniform, to_face)});
    Points corners;
    for (uint32_t k = 0; k < 8; ++k)
        corners.push_back({double(k & 1), double(k >> 1 & 1), double(k >> 2)});
    all.push_back({"on the box's corners, 8", {}, {1, 1, 1}, corners});
}

void addExtremeBoxes(std::vector<HardSites>& all, const Points& uniform) {
    const auto scaled = [&](double s) {
        return mapped(uniform, [s](Point& p, size_t) {
            for (double& x : p)
                x *= s;
        });
    };
    const auto slab = [&](double thickness) { return mapped(uniform, [thickness](Point& p, size_t) { p[2] *= thickness; }); };
    const Points far = mapped(uniform, [](Point& p, size_t) {
        for (double& x : p)
            x += 1e6;
    });
    all.push_back({"slab of thickness 1e-4", {}, {1, 1, 1e-4}, slab(1e-4)});
    all.push_back({"slab of thickness 1e-7", {}, {1, 1, 1e-7}, slab(1e-7)});
    all.push_back({"box 1e6 sizes from the origin", {1e6, 1e6, 1e6}, {1e6 + 1, 1e6 + 1, 1e6 + 1}, far});
    all.push_back({"box of size 1e9", {}, {1e9, 1e9, 1e9}, scaled(1e9)});
    all.push_back({"box of size 1e-9", {}, {1e-9, 1e-9, 1e-9}, scaled(1e-9)});
}

void addUneven(std::vector<HardSites>& all, const Points& uniform) {
    const auto crowd = [](Point& p, size_t) {
        for (double& x : p)
            x = .5 + (x - .5) * 1e-4;
    };
    all.push_back({"crowd of width 1e-4", {}, {1, 1, 1}, mapped(uniform, crowd)});
    all.push_back({"graded down to 2^-40", {}, {1, 1, 1}, graded(uniform, 40)});
    all.push_back({"one site", {}, {1, 1, 1}, {kCenter}});
    all.push_back({"two sites one bit apart", {}, {1, 1, 1}, {kCenter, {.5, .5, std::nextafter(.5, 1.)}}});
    all.push_back({"spiral sphere of 300 and its center", {}, {1, 1, 1}, joined({kCenter}, spiralSphere(300, .01))});
}

} // namespace

std::vector<HardSites> hardSites() {
    const Points uniform = uniformPoints(1000, kUniformSeed);
    std::vector<HardSites> all;
    addLattices(all);
    addRoundShapes(all);
    addFlatAndDouble(all, uniform);
    addBoxBound(all, uniform);
    addExtremeBoxes(all, uniform);
    addUneven(all, uniform);
    return all;
}

HardSites sphereAroundCenter(uint32_t face_count, double radius) {
    return {"sphere of " + std::to_string(face_count), {}, {1, 1, 1}, joined({kCenter}, spiralSphere(face_count, radius))};
}

HardSites cubicLattice(uint32_t side) {
    return {"cubic lattice of " + std::to_string(side), {}, {1, 1, 1}, lattice(side, {kCenter})};
}

HardSites clusters(uint32_t crowds, uint32_t members, double spread, uint32_t seed) {
    HardSites hard{std::to_string(crowds) + " crowds of " + std::to_string(members), {}, {1, 1, 1}, {}};
    Random random(seed);
    std::uniform_real_distribution<double> shift(-spread, spread);
    for (const Point& middle : uniformPoints(crowds, seed))
        for (uint32_t k = 0; k < members; ++k) {
            Point p = middle;
            for (double& x : p)
                x = std::clamp(x + shift(random), 0.0, 1.0);
            hard.sites.push_back(p);
        }
    return hard;
}

HardSites sitesAboutBlow(uint32_t count, double radius, uint32_t seed) {
    HardSites hard{std::to_string(count) + " sites about a blow", {}, {1, 1, 1}, {}};
    Random random(seed);
    std::uniform_real_distribution<double> share(0, 4.0 / 3 - radius / 0.5);
    std::normal_distribution<double> part;
    while (hard.sites.size() < count) {
        const double u = share(random), r = u < 1.0 / 3 ? radius * std::cbrt(3 * u) : radius / (4.0 / 3 - u);
        const Point d = {part(random), part(random), part(random)};
        const double size = std::hypot(d[0], d[1], d[2]);
        hard.sites.push_back({0.5 + r * d[0] / size, 0.5 + r * d[1] / size, 0.5 + r * d[2] / size});
    }
    return hard;
}

HardSites uniformSites(uint32_t count, uint32_t seed) {
    return {std::to_string(count) + " uniform sites", {}, {1, 1, 1}, uniformPoints(count, seed)};
}

GridSites snapToGrid(const HardSites& hard) {
    GridSites grid;
    double longest = 0;
    for (size_t k = 0; k < 3; ++k)
        longest = std::max(longest, hard.upper[k] - hard.lower[k]);
    const double scale = ((1 << 24) - 4) / longest;
    const auto steps = [&](double length) { return static_cast<int32_t>(std::lround(length * scale)); };
    for (size_t k = 0; k < 3; ++k)
        grid.set.box.upper[k] = std::max(1, steps(hard.upper[k] - hard.lower[k]));
    std::set<reference::GridPoint> seen;
    for (const Point& p : hard.sites) {
        reference::GridPoint q;
        for (size_t k = 0; k < 3; ++k)
            q[k] = std::clamp(steps(p[k] - hard.lower[k]), 0, grid.set.box.upper[k]);
        if (seen.insert(q).second)
            grid.set.sites.push_back(q);
        else
            ++grid.welded;
    }
    return grid;
}

} // namespace hard
