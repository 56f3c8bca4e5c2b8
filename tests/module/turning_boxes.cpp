#include "tests/module/turning_boxes.h"

#include <array>
#include <cmath>

namespace turning_boxes {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

// How far two boxes are apart along the axis that parts them most, negative where they overlap, and what touches along it.
struct Parting {
    double gap = -1e300;
    Vector3d normal = {0, 0, 0};  // from A to B
    int edge_a = -1, edge_b = -1; // own axes of the edges; -1: a corner of one and a face of the other
    bool by_face_of_a = false;
};

double reachAlong(const TurningBox& box, const Vector3d& normal) {
    return 0.5 * box.size.dot((box.turn.inverse() * normal).cwiseAbs());
}

void tryAxis(Parting& best, const TurningBox& a, const TurningBox& b, Vector3d normal, const Parting& touching) {
    if (normal.norm() < 1e-6) return;
    normal.normalize();
    const Vector3d way = b.place - a.place;
    if (normal.dot(way) < 0) normal = -normal;
    const double gap = normal.dot(way) - reachAlong(a, normal) - reachAlong(b, normal);
    if (gap <= best.gap + 1e-12) return;
    best = touching;
    best.gap = gap;
    best.normal = normal;
}

Parting partingOf(const TurningBox& a, const TurningBox& b) {
    const Matrix3d of_a = a.turn.toRotationMatrix(), of_b = b.turn.toRotationMatrix();
    Parting best;
    for (int i = 0; i < 3; ++i) {
        tryAxis(best, a, b, of_a.col(i), {.by_face_of_a = true});
        tryAxis(best, a, b, of_b.col(i), {});
    }
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            tryAxis(best, a, b, of_a.col(i).cross(of_b.col(j)), {.edge_a = i, .edge_b = j});
    return best;
}

// The corner furthest along a direction; without the way along one edge, the middle of that.
Vector3d furthest(const TurningBox& box, const Vector3d& direction, int edge) {
    Vector3d own = box.turn.inverse() * direction;
    for (int k = 0; k < 3; ++k)
        own[k] = k == edge ? 0 : std::copysign(0.5 * box.size[k], own[k]);
    return box.place + box.turn * own;
}

Vector3d placeOf(const TurningBox& a, const TurningBox& b, const Parting& p) {
    if (p.edge_a < 0) return p.by_face_of_a ? furthest(b, -p.normal, -1) : furthest(a, p.normal, -1);
    const Vector3d on_a = furthest(a, p.normal, p.edge_a), on_b = furthest(b, -p.normal, p.edge_b), apart = on_a - on_b;
    const Vector3d u = a.turn * Vector3d::Unit(p.edge_a), v = b.turn * Vector3d::Unit(p.edge_b);
    const double cosine = u.dot(v);
    return on_a + (cosine * v.dot(apart) - u.dot(apart)) / (1 - cosine * cosine) * u;
}

Vector3d velocityAt(const TurningBox& box, const Vector3d& at) {
    return box.velocity + (box.turn * (box.spin * Vector3d::Unit(box.axis))).cross(at - box.place);
}

double yieldOf(const TurningBox& box, const Vector3d& at, const Vector3d& normal, double density) {
    const double mass = density * box.size.prod();
    const Vector3d squares = box.size.cwiseAbs2(), lever = box.turn.inverse() * (at - box.place).cross(normal);
    double sum = 1 / mass;
    for (int k = 0; k < 3; ++k)
        sum += lever[k] * lever[k] / (mass / 12 * (squares.sum() - squares[k]));
    return sum;
}

} // namespace

brittle::BodyDescription TurningBox::described(const char* material) const {
    brittle::BodyDescription body;
    const Vector3d around = turn * (spin * Vector3d::Unit(axis));
    for (size_t k = 0; k < 3; ++k) {
        const auto c = static_cast<Eigen::Index>(k);
        body.shape.size[k] = size[c];
        body.place[k] = place[c];
        body.velocity[k] = velocity[c];
        body.spin[k] = around[c];
    }
    body.turn = {turn.x(), turn.y(), turn.z(), turn.w()};
    body.material = material;
    return body;
}

TurningBox TurningBox::after(double seconds) const {
    TurningBox then = *this;
    then.place += seconds * velocity;
    then.turn = turn * Eigen::Quaterniond(Eigen::AngleAxisd(seconds * spin, Vector3d::Unit(axis)));
    return then;
}

std::optional<Meeting> firstMeeting(const TurningBox& a, const TurningBox& b, double density) {
    constexpr double kWalk = 1e-4; // s
    double late = 0;
    while (partingOf(a.after(late), b.after(late)).gap > 0)
        if ((late += kWalk) > 1) return std::nullopt;
    double early = late - kWalk;
    for (int k = 0; k < 40; ++k) {
        const double middle = (early + late) / 2;
        (partingOf(a.after(middle), b.after(middle)).gap > 0 ? early : late) = middle;
    }
    const TurningBox then_a = a.after(late), then_b = b.after(late);
    const Parting parting = partingOf(then_a, then_b);
    const Vector3d at = placeOf(then_a, then_b, parting), n = parting.normal;
    const double yields = yieldOf(then_a, at, n, density) + yieldOf(then_b, at, n, density);
    return Meeting{late, n.dot(velocityAt(then_a, at) - velocityAt(then_b, at)), 1 / yields};
}

} // namespace turning_boxes
