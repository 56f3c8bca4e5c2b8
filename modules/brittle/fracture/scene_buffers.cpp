#include "modules/brittle/fracture/scene_buffers.h"

#include "shaders-spirv/shared/fragment_record.h"

namespace brittle {

engine::Result<SceneBuffers> SceneBuffers::create(engine::Device& device, uint32_t triangles, uint32_t fragments) {
    struct Wanted {
        engine::Buffer SceneBuffers::*buffer;
        VkDeviceSize bytes;
        VkBufferUsageFlags usage;
        const char* name;
    };
    const VkDeviceSize t = triangles, f = fragments;
    const Wanted wanted[] = {{&SceneBuffers::vertices, 3 * 32 * t, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "vertices"},
                             {&SceneBuffers::indices, 3 * 4 * t, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, "indices"},
                             {&SceneBuffers::draw_commands, 2 * 20 * f, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, "draw commands"},
                             {&SceneBuffers::objects, 96 * f, 0, "object information"},
                             {&SceneBuffers::matrices, 64 * f, 0, "model matrices"},
                             {&SceneBuffers::bounds, 24 * f, 0, "bounds"},
                             {&SceneBuffers::fragments, sizeof(FragmentRecord) * f, 0, "fragments"}};
    SceneBuffers scene;
    for (const Wanted& w : wanted) {
        auto buffer =
            engine::Buffer::create(device, std::max<VkDeviceSize>(w.bytes, 256), engine::BufferDomain::Device, w.usage, w.name);
        if (!buffer) return buffer.error();
        scene.*w.buffer = std::move(*buffer);
    }
    return scene;
}

} // namespace brittle
