// Draws a scene off screen, straight from the buffers that kernels have filled, with one indirect call.
#pragma once

#include "engine/buffer.h"
#include "engine/camera.h"
#include "engine/image_io.h"

#include <memory>
#include <span>

namespace engine {

class Device;

// Layouts are in shaders-spirv/shared/scene.h. `first_instance` of a command is twice its object plus its side.
struct DrawScene {
    BufferView vertices;      // SceneVertex; of a buffer with vertex usage
    BufferView indices;       // uint32; of a buffer with index usage
    BufferView draw_commands; // DrawCommand
    BufferView matrices;      // ObjectMatrix, one an object; rigid, or scaled evenly
    uint32_t draw_count = 0;
    // ObjectColor, one an object; empty: all have those of the look. What fades out has to come after what it may cover.
    BufferView colors = {};
};

// Colors are linear.
struct Look {
    Vec3 outer_color = {0.70f, 0.64f, 0.54f}; // light stone
    Vec3 inner_color = {0.60f, 0.20f, 0.07f}; // fired clay
    float tint = 0.06f;                       // how far the colors of the fragments differ, at most
    float light = 1.0f;
};

class Renderer {
public:
    // Fails where the device has no graphics queue, or cannot tell draws apart (drawIndirectFirstInstance).
    static Result<std::unique_ptr<Renderer>> create(Device& device, uint32_t width, uint32_t height);
    virtual ~Renderer() = default;

    // Waits for the picture. `released`: the buffers that a recording has given over with Commands::releaseToGraphics since
    // they were last drawn from; that recording has finished.
    virtual Result<Picture> draw(const DrawScene& scene, const Camera& camera, const Look& look = {},
                                 std::span<const BufferView> released = {}) = 0;
};

} // namespace engine
