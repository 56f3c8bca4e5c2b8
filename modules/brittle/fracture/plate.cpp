#include "modules/brittle/fracture/plate.h"

#include "modules/brittle/mesh/measures.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace brittle {
namespace {

using Place = std::array<double, 2>;

Eigen::Vector3d vectorOf(const Float3& p, const Double3& from) {
    const Double3 v = toDouble(p) - from;
    return {v[0], v[1], v[2]};
}

// Of the solid, over its volume, by tetrahedra from the center of mass.
Eigen::Matrix3d secondMoments(const Mesh& mesh, const MeshMeasures& measures) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Index3& t : mesh.triangles) {
        const Eigen::Vector3d a = vectorOf(mesh.positions[t[0]], measures.centroid),
                              b = vectorOf(mesh.positions[t[1]], measures.centroid),
                              c = vectorOf(mesh.positions[t[2]], measures.centroid), all = a + b + c;
        sum += a.dot(b.cross(c)) / 120 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + all * all.transpose());
    }
    return sum / measures.volume;
}

double turnOf(const Place& a, const Place& b, const Place& p) {
    return (a[0] - p[0]) * (b[1] - p[1]) - (a[1] - p[1]) * (b[0] - p[0]);
}

// The same for both triangles of an edge, but for the sign.
bool isLeftOf(const std::vector<Place>& places, uint32_t a, uint32_t b, const Place& p) {
    return a < b ? turnOf(places[a], places[b], p) >= 0 : turnOf(places[b], places[a], p) < 0;
}

// The integral of 1/r over the triangle of the origin and a side, negative where that is seen clockwise.
double underSide(const Place& from, const Place& to) {
    const Place way = {to[0] - from[0], to[1] - from[1]};
    const double size = std::hypot(way[0], way[1]), turn = from[0] * to[1] - from[1] * to[0], away = std::fabs(turn) / size;
    if (!(away > 1e-12 * size)) return 0;
    const auto along = [&](const Place& p) { return std::asinh((p[0] * way[0] + p[1] * way[1]) / (size * away)); };
    return std::copysign(away * (along(to) - along(from)), turn);
}

} // namespace

PrincipalBox principalBoxOf(const Mesh& mesh) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(secondMoments(mesh, measureMesh(mesh)));
    PrincipalBox box;
    for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d axis = solver.eigenvectors().col(k);
        box.edges[static_cast<size_t>(k)] = std::sqrt(12 * std::max(solver.eigenvalues()[k], 0.0));
        box.axes[static_cast<size_t>(k)] = {axis[0], axis[1], axis[2]};
    }
    return box;
}

Plate::Plate(const Mesh& mesh, const Double3& normal) : center_(measureMesh(mesh).centroid) {
    // Square plates have no axes of their own: those nearest to the model's.
    size_t least = 0;
    for (size_t k = 1; k < 3; ++k)
        least = std::fabs(normal[k]) < std::fabs(normal[least]) ? k : least;
    Double3 axis = {0, 0, 0};
    axis[least] = 1;
    along_ = normalized(cross(normal, axis), axis);
    across_ = cross(along_, normal);
    for (const Float3& p : mesh.positions) {
        places_.push_back(onPlane(toDouble(p)));
        for (size_t k = 0; k < 2; ++k) {
            low_[k] = std::min(low_[k], places_.back()[k]);
            high_[k] = std::max(high_[k], places_.back()[k]);
        }
    }
    for (const Index3& t : mesh.triangles) {
        const double turn = turnOf(places_[t[1]], places_[t[2]], places_[t[0]]);
        if (!(turn > 0)) continue;
        area_ += turn / 2;
        facing_.push_back(t);
    }
    fillBins();
}

std::array<double, 2> Plate::onPlane(const Double3& local) const {
    return {dot(local - center_, across_), dot(local - center_, along_)};
}

Double3 Plate::fromPlane(const Place& p) const { return center_ + p[0] * across_ + p[1] * along_; }

size_t Plate::binOf(double x, size_t axis) const {
    const double share = (x - low_[axis]) / (high_[axis] - low_[axis]);
    return static_cast<size_t>(std::clamp(share, 0.0, 1.0 - 1e-9) * static_cast<double>(per_axis_));
}

void Plate::fillBins() {
    per_axis_ = std::clamp<size_t>(static_cast<size_t>(std::sqrt(static_cast<double>(facing_.size()))), 1, 512);
    bins_.resize(per_axis_ * per_axis_);
    for (uint32_t t = 0; t < facing_.size(); ++t) {
        Place low = places_[facing_[t][0]], high = low;
        for (const uint32_t v : facing_[t])
            for (size_t k = 0; k < 2; ++k) {
                low[k] = std::min(low[k], places_[v][k]);
                high[k] = std::max(high[k], places_[v][k]);
            }
        for (size_t y = binOf(low[1], 1); y <= binOf(high[1], 1); ++y)
            for (size_t x = binOf(low[0], 0); x <= binOf(high[0], 0); ++x)
                bins_[y * per_axis_ + x].push_back(t);
    }
}

// A line that goes through the solid leaves it through a face that looks along it.
bool Plate::isInside(const Place& p) const {
    for (size_t k = 0; k < 2; ++k)
        if (!(p[k] >= low_[k]) || !(p[k] <= high_[k])) return false;
    for (const uint32_t t : bins_[binOf(p[1], 1) * per_axis_ + binOf(p[0], 0)]) {
        const Index3& v = facing_[t];
        if (isLeftOf(places_, v[0], v[1], p) && isLeftOf(places_, v[1], v[2], p) && isLeftOf(places_, v[2], v[0], p))
            return true;
    }
    return false;
}

double Plate::reachFrom(const Place& p) const {
    double sum = 0;
    for (const Index3& t : facing_) {
        std::array<Place, 3> corners;
        for (size_t k = 0; k < 3; ++k)
            corners[k] = {places_[t[k]][0] - p[0], places_[t[k]][1] - p[1]};
        sum += std::fabs(underSide(corners[0], corners[1]) + underSide(corners[1], corners[2]) +
                         underSide(corners[2], corners[0]));
    }
    return sum / (2 * std::numbers::pi);
}

double Plate::furthestFrom(const Place& p) const {
    double most = 0;
    for (const Place& v : places_)
        most = std::max(most, std::hypot(v[0] - p[0], v[1] - p[1]));
    return most;
}

} // namespace brittle
