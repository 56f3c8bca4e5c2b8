#include "engine/camera.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace engine {

namespace {

constexpr float kMargin = 1.06f; // empty border around a framed box

Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

float dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec3 normalized(const Vec3& a) {
    const float length = std::sqrt(dot(a, a));
    if (!(length > 0)) return {0, 0, 1};
    return {a[0] / length, a[1] / length, a[2] / length};
}

// Axes of the picture: to the right, upwards, towards the eye.
struct Axes {
    Vec3 right, up, back;
};

Axes axesOf(const Vec3& back, const Vec3& up) {
    const Vec3 towards = normalized(back);
    Vec3 right = cross(up, towards);
    if (dot(right, right) < 1e-8f) right = cross({0, 0, -1}, towards); // straight up or down
    right = normalized(right);
    return {right, cross(towards, right), towards};
}

gpu::mat4 product(const gpu::mat4& a, const gpu::mat4& b) {
    gpu::mat4 c{};
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            for (int k = 0; k < 4; ++k)
                c.m[4 * column + row] += a.m[4 * k + row] * b.m[4 * column + k];
        }
    }
    return c;
}

} // namespace

gpu::mat4 Camera::viewProjection(float aspect) const {
    const Axes a = axesOf(eye - target, up);
    const gpu::mat4 view{{a.right[0], a.up[0], a.back[0], 0, //
                          a.right[1], a.up[1], a.back[1], 0, //
                          a.right[2], a.up[2], a.back[2], 0, //
                          -dot(a.right, eye), -dot(a.up, eye), -dot(a.back, eye), 1}};
    const float focal = 1 / std::tan(fov_y / 2), depth = far_plane / (near_plane - far_plane);
    const gpu::mat4 projection{{focal / aspect, 0, 0, 0, //
                                0, -focal, 0, 0,         //
                                0, 0, depth, -1,         //
                                0, 0, near_plane * depth, 0}};
    return product(projection, view);
}

Vec3 keyLight(const Camera& camera) {
    const Axes a = axesOf(camera.eye - camera.target, camera.up);
    Vec3 light;
    for (size_t k = 0; k < 3; ++k)
        light[k] = -0.55f * a.right[k] + 0.85f * a.up[k] + 0.65f * a.back[k];
    return normalized(light);
}

// In the picture's axes a point (x, y, z) around the target is inside the picture's cone if the eye is at least
// max(|x| / tan_x, |y| / tan_y) + z away from the target.
Camera framePoints(std::span<const Vec3> points, float aspect, const Vec3& direction) {
    Camera camera;
    const Axes axes = axesOf(direction, camera.up);
    const std::array<Vec3, 3> rows = {axes.right, axes.up, axes.back};
    Vec3 lower = {FLT_MAX, FLT_MAX, FLT_MAX}, upper = {-FLT_MAX, -FLT_MAX, -FLT_MAX};
    for (const Vec3& p : points) {
        for (size_t k = 0; k < 3; ++k) {
            lower[k] = std::min(lower[k], dot(p, rows[k]));
            upper[k] = std::max(upper[k], dot(p, rows[k]));
        }
    }
    if (points.empty()) lower = upper = {0, 0, 0};
    Vec3 center;
    for (size_t k = 0; k < 3; ++k)
        center[k] = (lower[k] + upper[k]) / 2;
    const float tan_y = std::tan(camera.fov_y / 2), tan_x = tan_y * aspect;
    const float depth = (upper[2] - lower[2]) / 2;
    float distance = 0;
    for (const Vec3& p : points) {
        const float x = std::abs(dot(p, axes.right) - center[0]), y = std::abs(dot(p, axes.up) - center[1]);
        distance = std::max(distance, kMargin * std::max(x / tan_x, y / tan_y) + dot(p, axes.back) - center[2]);
    }
    distance = std::max({distance, 1.1f * depth, 1e-6f});
    for (size_t k = 0; k < 3; ++k) {
        camera.target[k] = center[0] * axes.right[k] + center[1] * axes.up[k] + center[2] * axes.back[k];
        camera.eye[k] = camera.target[k] + distance * axes.back[k];
    }
    camera.near_plane = std::max(distance - 1.05f * depth, 0.01f * distance);
    camera.far_plane = distance + 1.05f * depth + 0.01f * distance;
    return camera;
}

Camera frameBounds(const Vec3& lower, const Vec3& upper, float aspect, const Vec3& direction) {
    std::array<Vec3, 8> corners;
    for (unsigned corner = 0; corner < 8; ++corner) {
        for (unsigned k = 0; k < 3; ++k)
            corners[corner][k] = (corner >> k & 1u) != 0 ? upper[k] : lower[k];
    }
    return framePoints(corners, aspect, direction);
}

} // namespace engine
