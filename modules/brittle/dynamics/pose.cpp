#include "modules/brittle/dynamics/pose.h"

#include "modules/brittle/dynamics/sector_place.h"
#include "modules/brittle/mesh/vector_math.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace brittle {
namespace {

constexpr double kOriginStep = 1024; // m

Double3 xyz(const gpu::vec4& v) { return {v.x, v.y, v.z}; }

Eigen::Quaterniond rotation(const Turn& t) { return Eigen::Quaterniond(t[3], t[0], t[1], t[2]).normalized(); }

Turn turnOf(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }

Double3 turned(const Eigen::Quaterniond& turn, const Double3& v) {
    const Eigen::Vector3d r = turn * Eigen::Vector3d(v[0], v[1], v[2]);
    return {r.x(), r.y(), r.z()};
}

} // namespace

Double3 turnedBy(const Turn& turn, const Double3& v) { return turned(rotation(turn), v); }
Double3 turnedBack(const Turn& turn, const Double3& v) { return turned(rotation(turn).conjugate(), v); }

Pose poseOf(const gpu::BodyState& body) {
    const gpu::vec4& q = body.turn;
    return {placeOf(body.sector, body.offset), turnOf(rotation({q.x, q.y, q.z, q.w}))};
}

Pose between(const Pose& a, const Pose& b, double share) {
    return {a.place + share * (b.place - a.place), turnOf(rotation(a.turn).slerp(share, rotation(b.turn))),
            a.scale + share * (b.scale - a.scale)};
}

Poses between(const Poses& a, const Poses& b, double share) {
    Poses poses = a;
    for (size_t body = 0; body < std::min(a.size(), b.size()); ++body)
        if (a[body] && b[body]) poses[body] = between(*a[body], *b[body], share);
    return poses;
}

double kineticEnergyOf(std::span<const gpu::BodyState> bodies) {
    double sum = 0;
    for (const gpu::BodyState& body : bodies) {
        const Double3 v = xyz(body.velocity);
        if (body.offset.w > 0) sum += 0.5 * dot(v, v) / body.offset.w + 0.5 * dot(xyz(body.momentum), xyz(body.spin));
    }
    return sum;
}

Double3 originOf(std::span<const gpu::BodyState> bodies) {
    Box box;
    for (const gpu::BodyState& body : bodies)
        if (body.offset.w > 0) box.grow(placeOf(body.sector, body.offset));
    Double3 origin = {0, 0, 0};
    if (box.lower[0] > box.upper[0]) return origin;
    for (size_t k = 0; k < 3; ++k)
        origin[k] = kOriginStep * std::round((box.lower[k] + box.upper[k]) / 2 / kOriginStep);
    return origin;
}

} // namespace brittle
