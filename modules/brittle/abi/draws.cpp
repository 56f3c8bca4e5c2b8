#include "modules/brittle/abi/boundary.h"
#include "modules/brittle/abi/conversions.h"

static_assert(sizeof(BrittleVertex) == sizeof(gpu::SceneVertex) && sizeof(BrittleDrawnBody) == sizeof(gpu::DrawnBody));
static_assert(sizeof(gpu::DrawCommand) == sizeof(VkDrawIndexedIndirectCommand));

namespace {

using namespace brittle::abi;

void mustHaveSurfaces(const HostedWorld& world) {
    if (!world.has_surfaces)
        throw Refusal(BRITTLE_BAD_VALUE, "the world was made with has_surfaces = 0, and has nothing to be drawn");
}

void give(const engine::BufferView& view, VkBuffer& buffer, uint64_t& offset, uint64_t& bytes) {
    buffer = view.buffer->handle();
    offset = view.offset;
    bytes = view.size;
}

BrittleDrawBuffers buffersOf(const brittle::DrawBuffers& from) {
    BrittleDrawBuffers to = {};
    to.struct_size = sizeof to;
    to.generation = from.generation;
    give(from.vertices, to.vertex_buffer, to.vertex_offset, to.vertex_bytes);
    give(from.indices, to.index_buffer, to.index_offset, to.index_bytes);
    give(from.commands, to.draw_buffer, to.draw_offset, to.draw_bytes);
    give(from.matrices, to.matrix_buffer, to.matrix_offset, to.matrix_bytes);
    give(from.bodies, to.body_buffer, to.body_offset, to.body_bytes);
    to.draw_count = from.draw_count;
    to.draw_stride = sizeof(gpu::DrawCommand);
    return to;
}

} // namespace

BrittleResult brittleGetDrawBuffers(BrittleContext* context, BrittleWorld world, BrittleDrawBuffers* buffers) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& w = c.worlds.at(world.id);
        BrittleDrawBuffers& out = sized(buffers, "buffers");
        brittle::World& running = w.running();
        mustHaveSurfaces(w);
        out = buffersOf(orRefuse(running.drawBuffers()));
        w.is_drawn = true;
    });
}

BrittleResult brittleRecordDraws(BrittleContext* context, BrittleWorld world, VkCommandBuffer commands, BrittleVec3 origin) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& w = c.worlds.at(world.id);
        brittle::World& recording = w.recording();
        needed(commands, "commands");
        mustHaveSurfaces(w);
        if (!w.is_drawn)
            throw Refusal(BRITTLE_WRONG_ORDER, "draw buffers are made by brittleGetDrawBuffers, which has to be called before");
        orRefuse(recording.recordDraws(commands, tripleOf(origin)));
    });
}

BrittleResult brittleUpdateDraws(BrittleContext* context, BrittleWorld world, BrittleVec3 origin) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& w = c.worlds.at(world.id);
        brittle::World& running = w.running();
        mustHaveSurfaces(w);
        orRefuse(running.updateDraws(tripleOf(origin)));
        w.is_drawn = true;
    });
}
