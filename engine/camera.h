// Where the picture is taken from. Right-handed, y up.
#pragma once

#include "shaders-spirv/shared/scene.h"

#include <array>

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

// Sees the whole box as large as it fits, from `direction` (from the box towards the eye; any length but 0).
Camera frameBounds(const Vec3& lower, const Vec3& upper, float aspect, const Vec3& direction = {0.55f, 0.45f, 1.0f});

} // namespace engine
