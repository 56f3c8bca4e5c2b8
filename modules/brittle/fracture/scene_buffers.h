// The scene's buffers (the paper, section 2), from which everything is drawn in one indirect call.
#pragma once

#include "engine/buffer.h"
#include "modules/brittle/fracture/event.h"

namespace brittle {

struct SceneBuffers {
    engine::Buffer vertices, indices, draw_commands, objects, matrices, bounds, fragments;

    // Room for so many triangles and fragments; each fragment has two draw commands, outer and inner.
    static engine::Result<SceneBuffers> create(engine::Device& device, uint32_t triangles, uint32_t fragments);
    ScenePools views() const { return {vertices, indices, draw_commands, objects, matrices, bounds, fragments}; }
};

} // namespace brittle
