#include "modules/brittle/godot/conversion/placement.h"

#include <array>
#include <cmath>

namespace brittle_godot {
namespace {

using Column = std::array<double, 3>;

Column columnOf(const Transform& t, int k) { return {t.basis[0][k], t.basis[1][k], t.basis[2][k]}; }
double dot(const Column& a, const Column& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Column cross(const Column& a, const Column& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Column scaled(const Column& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
Column minus(const Column& a, const Column& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Column unit(const Column& a) { return scaled(a, 1 / std::sqrt(dot(a, a))); }

double determinant(const Transform& t) { return dot(columnOf(t, 0), cross(columnOf(t, 1), columnOf(t, 2))); }

// Of a turn by its columns, by whichever of the four is largest.
BrittleQuat quatOf(const Column& x, const Column& y, const Column& z) {
    const double trace = x[0] + y[1] + z[2];
    BrittleQuat q = {y[2] - z[1], z[0] - x[2], x[1] - y[0], 1 + trace};
    if (trace <= 0 && x[0] >= y[1] && x[0] >= z[2])
        q = {1 + x[0] - y[1] - z[2], y[0] + x[1], z[0] + x[2], y[2] - z[1]};
    else if (trace <= 0 && y[1] >= z[2])
        q = {y[0] + x[1], 1 - x[0] + y[1] - z[2], z[1] + y[2], z[0] - x[2]};
    else if (trace <= 0)
        q = {z[0] + x[2], z[1] + y[2], 1 - x[0] - y[1] + z[2], x[1] - y[0]};
    const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return {q.x / length, q.y / length, q.z / length, q.w / length};
}

Transform turnOf(const BrittleQuat& q) {
    const double n = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    const double s = n > 0 ? 2 / n : 0;
    const double rows[3][3] = {{1 - s * (q.y * q.y + q.z * q.z), s * (q.x * q.y - q.z * q.w), s * (q.x * q.z + q.y * q.w)},
                               {s * (q.x * q.y + q.z * q.w), 1 - s * (q.x * q.x + q.z * q.z), s * (q.y * q.z - q.x * q.w)},
                               {s * (q.x * q.z - q.y * q.w), s * (q.y * q.z + q.x * q.w), 1 - s * (q.x * q.x + q.y * q.y)}};
    Transform t;
    for (int row = 0; row < 3; ++row)
        for (int k = 0; k < 3; ++k)
            t.basis[row][k] = static_cast<float>(rows[row][k]);
    return t;
}

} // namespace

Placement placementOf(const Transform& t) {
    constexpr double kFlat = 1e-18; // m3: a nanometer, cubed, and less of anything larger
    Placement p;
    p.position = toBrittle(t.origin);
    const double volume = determinant(t);
    p.is_flat = !(std::fabs(volume) > kFlat);
    if (p.is_flat) return p;
    p.is_mirrored = volume < 0;
    const Column x = unit(columnOf(t, 0));
    const Column y = unit(minus(columnOf(t, 1), scaled(x, dot(x, columnOf(t, 1)))));
    const Column z = cross(x, y); // so that mirroring is in the stretch
    p.rotation = quatOf(x, y, z);
    const Column axes[3] = {x, y, z};
    for (int row = 0; row < 3; ++row)
        for (int k = 0; k < 3; ++k)
            p.stretch.basis[row][k] = static_cast<float>(dot(axes[row], columnOf(t, k)));
    return p;
}

Transform transformOf(const BrittleVec3& position, const BrittleQuat& rotation, const Transform& stretch) {
    Transform turn = turnOf(rotation);
    turn.origin = toEngine(position);
    return product(turn, stretch);
}

Transform product(const Transform& a, const Transform& b) {
    Transform t;
    for (int row = 0; row < 3; ++row)
        for (int k = 0; k < 3; ++k)
            t.basis[row][k] =
                a.basis[row][0] * b.basis[0][k] + a.basis[row][1] * b.basis[1][k] + a.basis[row][2] * b.basis[2][k];
    t.origin = moved(a, b.origin);
    return t;
}

Transform inverse(const Transform& t) {
    const Column x = columnOf(t, 0), y = columnOf(t, 1), z = columnOf(t, 2);
    const double volume = determinant(t);
    const Column rows[3] = {cross(y, z), cross(z, x), cross(x, y)};
    Transform inverted;
    for (int row = 0; row < 3; ++row)
        for (size_t k = 0; k < 3; ++k)
            inverted.basis[row][k] = static_cast<float>(rows[row][k] / volume);
    const Vec3 origin = moved(inverted, t.origin);
    inverted.origin = {-origin.x, -origin.y, -origin.z};
    return inverted;
}

Vec3 moved(const Transform& t, const Vec3& p) {
    const auto row = [&](int k) { return t.basis[k][0] * p.x + t.basis[k][1] * p.y + t.basis[k][2] * p.z; };
    return {row(0) + t.origin.x, row(1) + t.origin.y, row(2) + t.origin.z};
}

Vec3 turnedNormal(const Transform& t, const Vec3& n) {
    const Column x = columnOf(t, 0), y = columnOf(t, 1), z = columnOf(t, 2);
    const Column a = cross(y, z), b = cross(z, x), c = cross(x, y);
    const double side = determinant(t) < 0 ? -1 : 1;
    const auto row = [&](size_t k) { return static_cast<float>(side * (a[k] * n.x + b[k] * n.y + c[k] * n.z)); };
    return {row(0), row(1), row(2)};
}

BrittleVec3 toBrittle(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 toEngine(const BrittleVec3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

} // namespace brittle_godot
