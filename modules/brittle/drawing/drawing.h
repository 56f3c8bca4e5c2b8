// What a world has for whoever draws it: one list of vertices, one of indices, and, written on the device after any step, two
// draw commands and a matrix for each slot of a body, so that one vkCmdDrawIndexedIndirect draws all of it. Nobody copies
// anything to the host, and what nobody draws has none of this.
#pragma once

#include "engine/commands.h"
#include "engine/kernel.h"
#include "modules/brittle/dynamics/body_surface.h"
#include "shaders-spirv/shared/drawing.h"
#include "shaders-spirv/shared/scene.h"

#include <memory>
#include <optional>

namespace brittle {

// Device buffers. `first_instance` of a command is twice the slot of its body, plus 1 for faces of cuts.
struct DrawBuffers {
    engine::BufferView vertices; // SceneVertex, in the frames that matrices are from; of a buffer with vertex usage
    engine::BufferView indices;  // uint32; of a buffer with index usage
    engine::BufferView commands; // DrawCommand, `draw_count` of them
    engine::BufferView matrices; // ObjectMatrix, a slot each
    engine::BufferView bodies;   // DrawnBody, a slot each
    uint32_t draw_count = 0;
    uint32_t generation = 0; // other buffers have another
};

// Surfaces of bodies that do not break become part of what the device has of a world, so that they can be drawn. `surfaces`: of
// these contents, in their order (contentsOf).
void addLooks(WorldContents& contents, const WorldSurfaces& surfaces);

class Drawing {
public:
    // What it reads of the world.
    struct Source {
        engine::BufferView bodies;                   // BodyState
        std::optional<engine::BufferView> breakable; // BreakableBody; none where nothing breaks
        std::optional<engine::BufferView> clocks;    // DebrisClock; none where nothing fades
        std::optional<engine::BufferView> vertices;  // SceneVertex of all surfaces, where the device has them already
        float fades_after = 0, fade_duration = 0;    // s
        uint32_t slots = 0;                          // of bodies
        std::vector<uint32_t> as_added;              // of these that have been there from the beginning, their index as added
    };
    // `kernels` outlive it. Errors: Capacity, Device.
    static engine::Result<std::unique_ptr<Drawing>> create(engine::Device& device, engine::KernelLibrary& kernels,
                                                           const WorldContents& contents, Source source, uint32_t generation);

    const DrawBuffers& buffers() const { return views_; }
    // Writes commands and matrices, of the bodies as they are when it is executed; places count from `origin`, m, world. The
    // first into a command buffer of another, as Commands::executeIn; the second submits and waits.
    void record(VkCommandBuffer commands, const Double3& origin) const;
    engine::Result<void> update(const Double3& origin) const;
    // With its kernel as it is now; not before the device has finished with what was recorded.
    engine::Result<void> recordAgain();

private:
    Drawing(engine::Device& device, Source source) : device_(device), source_(std::move(source)) {}
    engine::Result<void> make(const WorldContents& contents);
    engine::Result<void> fill(const WorldContents& contents);
    void dispatch(engine::Commands& commands) const;

    engine::Device& device_;
    Source source_;
    const engine::Kernel* kernel_ = nullptr;
    engine::Buffer own_vertices_, indices_, commands_, matrices_, drawn_, looks_, from_;
    std::unique_ptr<engine::Commands> recording_;
    DrawBuffers views_;
};

} // namespace brittle
