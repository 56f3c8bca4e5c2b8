#include "engine/camera.h"

#include <algorithm>
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
    const gpu::mat4 view{{a.right[0], a.up[0], a.back[0], 0,                                    //
                          a.right[1], a.up[1], a.back[1], 0,                                    //
                          a.right[2], a.up[2], a.back[2], 0,                                    //
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

// A corner at (x, y, z) in the picture's axes, around the box's center, is inside the picture's cone if the eye is at least
// max(|x| / tan_x, |y| / tan_y) + z away.
Camera frameBounds(const Vec3& lower, const Vec3& upper, float aspect, const Vec3& direction) {
    Camera camera;
    const Axes axes = axesOf(direction, camera.up);
    const float tan_y = std::tan(camera.fov_y / 2), tan_x = tan_y * aspect;
    Vec3 half;
    for (size_t k = 0; k < 3; ++k) {
        camera.target[k] = (lower[k] + upper[k]) / 2;
        half[k] = (upper[k] - lower[k]) / 2;
    }
    float distance = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        Vec3 c;
        for (unsigned k = 0; k < 3; ++k)
            c[k] = (corner >> k & 1u) != 0 ? half[k] : -half[k];
        const float side = std::max(std::abs(dot(c, axes.right)) / tan_x, std::abs(dot(c, axes.up)) / tan_y);
        distance = std::max(distance, kMargin * side + dot(c, axes.back));
    }
    const float radius = std::max(std::sqrt(dot(half, half)), 1e-6f);
    distance = std::max(distance, radius * kMargin);
    for (size_t k = 0; k < 3; ++k)
        camera.eye[k] = camera.target[k] + distance * axes.back[k];
    camera.near_plane = std::max(distance - 1.5f * radius, distance * 0.01f);
    camera.far_plane = distance + 1.5f * radius;
    return camera;
}

} // namespace engine
