#include "tests/reference/rigid_motion.h"

#include <algorithm>
#include <cmath>

namespace reference {
namespace {

constexpr double kLongest = 1e-4; // s, a step

using Row = std::array<double, 3>;

// Rows of the rotation matrix.
std::array<Row, 3> matrixOf(const UnitQuaternion& q) {
    const auto& [x, y, z, w] = q;
    return {Row{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
            Row{2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
            Row{2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
}

Point spinAt(const FreeTurning& body, const UnitQuaternion& turn) {
    const auto m = matrixOf(turn);
    Point spin = {0, 0, 0};
    for (size_t axis = 0; axis < 3; ++axis) {
        double along = 0;
        for (size_t k = 0; k < 3; ++k)
            along += m[k][axis] * body.momentum[k];
        for (size_t k = 0; k < 3; ++k)
            spin[k] += m[k][axis] * along / body.moments[axis];
    }
    return spin;
}

// Half the spin times the turn, as quaternions.
UnitQuaternion rateOf(const FreeTurning& body, const UnitQuaternion& turn) {
    const Point s = spinAt(body, turn), v = {turn[0], turn[1], turn[2]};
    const Point side = turn[3] * s + cross(s, v);
    return {side[0] / 2, side[1] / 2, side[2] / 2, -dot(s, v) / 2};
}

UnitQuaternion moved(const UnitQuaternion& q, double h, const UnitQuaternion& rate) {
    return {q[0] + h * rate[0], q[1] + h * rate[1], q[2] + h * rate[2], q[3] + h * rate[3]};
}

UnitQuaternion normalized(const UnitQuaternion& q) {
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    return {q[0] / size, q[1] / size, q[2] / size, q[3] / size};
}

UnitQuaternion oneStep(const FreeTurning& body, const UnitQuaternion& q, double h) {
    const UnitQuaternion a = rateOf(body, q), b = rateOf(body, moved(q, h / 2, a)), c = rateOf(body, moved(q, h / 2, b)),
                         d = rateOf(body, moved(q, h, c));
    UnitQuaternion sum;
    for (size_t k = 0; k < 4; ++k)
        sum[k] = (a[k] + 2 * b[k] + 2 * c[k] + d[k]) / 6;
    return normalized(moved(q, h, sum));
}

} // namespace

Point spinOf(const FreeTurning& body) { return spinAt(body, body.turn); }

UnitQuaternion turnAfter(const FreeTurning& body, double seconds) {
    const auto steps = static_cast<size_t>(std::ceil(seconds / kLongest));
    UnitQuaternion turn = body.turn;
    for (size_t k = 0; k < steps; ++k)
        turn = oneStep(body, turn, seconds / static_cast<double>(steps));
    return turn;
}

double angleBetween(const UnitQuaternion& a, const UnitQuaternion& b) {
    // From the difference: the arc cosine of what is nearly one has no digits left.
    const double sign = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] < 0 ? -1 : 1;
    double square = 0;
    for (size_t k = 0; k < 4; ++k)
        square += (a[k] - sign * b[k]) * (a[k] - sign * b[k]);
    return 4 * std::asin(std::min(1.0, std::sqrt(square) / 2));
}

} // namespace reference
