// Where the picture is taken from. Right-handed, y up.
#pragma once

#include "shaders-spirv/shared/scene.h"

#include <array>
#include <span>

namespace engine {

using Vec3 = std::array<float, 3>;

struct Camera {
    Vec3 eye = {0, 0, 5};
    Vec3 target = {0, 0, 0};
    Vec3 up = {0, 1, 0};
    float fov_y = 0.6f; // radians
    float near_plane = 0.1f;
    float far_plane = 100.0f;

    // Into Vulkan's clip space, y down and depth from 0 to 1.
    gpu::mat4 viewProjection(float aspect) const;
};

// Towards a light above the left shoulder of whoever looks; unit length.
Vec3 keyLight(const Camera& camera);

// Sees all points as large as they fit, from `direction` (from the points towards the eye; any length but 0).
constexpr Vec3 kFromTheFront = {0.55f, 0.45f, 1.0f};
Camera framePoints(std::span<const Vec3> points, float aspect, const Vec3& direction = kFromTheFront);

// The same for a box. Looser than the corners of many small boxes.
Camera frameBounds(const Vec3& lower, const Vec3& upper, float aspect, const Vec3& direction = kFromTheFront);

} // namespace engine
