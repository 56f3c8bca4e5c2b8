#include "modules/brittle/drawing/drawing.h"

#include "modules/brittle/dynamics/sector_place.h"
#include "modules/brittle/fracture/upload.h"
#include "shaders-spirv/shared/breaking.h"
#include "shaders-spirv/shared/debris.h"
#include "shaders-spirv/shared/fracture.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace brittle {
namespace {

using engine::Buffer;
using engine::BufferDomain;
using engine::BufferView;
using engine::Commands;
using engine::Result;

bool canBreak(const WorldContents& contents, size_t body) {
    return body < contents.breakable.size() && contents.breakable[body].surface.w != NO_INDEX;
}

gpu::BodyLook appendSurface(WorldContents& contents, const SurfaceMesh& surface) {
    const auto first = static_cast<uint32_t>(contents.surface_vertices.size());
    for (const uint32_t index : surface.indices)
        contents.surface_vertices.push_back(surface.vertices[index]);
    const auto corners = static_cast<uint32_t>(surface.indices.size());
    return {{first, surface.outer_index_count, corners - surface.outer_index_count, 0}};
}

gpu::DrawnFrom fromOf(const Double3& origin) {
    const SectorPlace place = inSectors(origin);
    return {place.sector, {place.offset[0], place.offset[1], place.offset[2], 0}};
}

} // namespace

void addLooks(WorldContents& contents, const WorldSurfaces& surfaces) {
    ENGINE_ASSERT(surfaces.bodies.size() == contents.bodies.size());
    contents.looks.assign(contents.bodies.size(), {});
    std::unordered_map<uint32_t, gpu::BodyLook> by_mesh;
    for (size_t body = 0; body < contents.bodies.size(); ++body) {
        if (canBreak(contents, body)) continue;
        const uint32_t mesh = surfaces.bodies[body].mesh;
        const auto [look, is_new] = by_mesh.try_emplace(mesh);
        if (is_new) look->second = appendSurface(contents, surfaces.meshes[mesh]);
        contents.looks[body] = look->second;
    }
}

Result<std::unique_ptr<Drawing>> Drawing::create(engine::Device& device, engine::KernelLibrary& kernels,
                                                 const WorldContents& contents, Source source, uint32_t generation) {
    std::unique_ptr<Drawing> drawing(new Drawing(device, std::move(source)));
    if (auto made = drawing->make(contents); !made) return made.error();
    if (auto filled = drawing->fill(contents); !filled) return filled.error();
    const auto kernel = kernels.get("write_draws");
    if (!kernel) return kernel.error();
    drawing->kernel_ = *kernel;
    if (auto recorded = drawing->recordAgain(); !recorded) return recorded.error();
    drawing->views_.generation = generation;
    return drawing;
}

Result<void> Drawing::make(const WorldContents& contents) {
    const uint64_t slots = source_.slots, corners = contents.surface_vertices.size();
    struct Wanted {
        Buffer& buffer;
        uint64_t bytes;
        VkBufferUsageFlags usage;
        const char* name;
    } const wanted[] = {{own_vertices_, source_.vertices ? 0 : std::max<uint64_t>(corners, 3) * sizeof(FragmentVertex),
                         VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "drawn vertices"},
                        {indices_, 4 * std::max<uint64_t>(corners, 3), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, "drawn indices"},
                        {commands_, 2 * slots * sizeof(gpu::DrawCommand), VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, "draws"},
                        {matrices_, slots * sizeof(gpu::ObjectMatrix), 0, "drawn matrices"},
                        {drawn_, slots * sizeof(gpu::DrawnBody), 0, "drawn bodies"},
                        {looks_, slots * sizeof(gpu::BodyLook), 0, "looks"},
                        {from_, sizeof(gpu::DrawnFrom), 0, "drawn from"}};
    for (const auto& [buffer, bytes, usage, name] : wanted) {
        if (bytes == 0) continue;
        auto made = Buffer::create(device_, bytes, BufferDomain::Device, usage, name);
        if (!made) return made.error();
        buffer = std::move(*made);
    }
    views_ = {source_.vertices ? *source_.vertices : BufferView(own_vertices_),
              indices_,
              commands_,
              matrices_,
              drawn_,
              static_cast<uint32_t>(2 * slots),
              0};
    return {};
}

// Each vertex is used once, so indices count up.
Result<void> Drawing::fill(const WorldContents& contents) {
    std::vector<uint32_t> indices(contents.surface_vertices.size());
    std::iota(indices.begin(), indices.end(), 0u);
    std::vector<gpu::BodyLook> looks = contents.looks;
    looks.resize(source_.slots);
    for (uint32_t slot = 0; slot < source_.slots; ++slot)
        looks[slot].surface.w = slot < source_.as_added.size() ? source_.as_added[slot] : slot;
    Upload upload;
    if (!source_.vertices) upload.add(std::span(contents.surface_vertices), own_vertices_);
    upload.add(std::span<const uint32_t>(indices), indices_);
    upload.add(std::span<const gpu::BodyLook>(looks), looks_);
    return upload.send(device_);
}

Result<void> Drawing::recordAgain() {
    auto recording = std::make_unique<Commands>(device_);
    if (auto begun = recording->begin(Commands::Reuse::ByOthers); !begun) return begun;
    dispatch(*recording);
    if (auto ended = recording->end(); !ended) return ended;
    recording_ = std::move(recording);
    return {};
}

void Drawing::dispatch(Commands& commands) const {
    const struct {
        uint32_t slots, breaks;
        float fades_after, fade_duration;
    } push = {source_.slots, source_.breakable ? 1u : 0u, source_.clocks ? source_.fades_after : -1.0f, source_.fade_duration};
    const BufferView none = looks_;
    commands.dispatch(*kernel_, source_.slots, push,
                      {source_.bodies, source_.breakable.value_or(none), looks_, source_.clocks.value_or(none), from_,
                       commands_, matrices_, drawn_});
}

void Drawing::record(VkCommandBuffer commands, const Double3& origin) const {
    const gpu::DrawnFrom from = fromOf(origin);
    Commands outer(device_, commands);
    outer.separate(); // the last execution may still read it
    outer.update(from_, std::as_bytes(std::span(&from, 1)));
    recording_->executeIn(commands);
}

Result<void> Drawing::update(const Double3& origin) const {
    const gpu::DrawnFrom from = fromOf(origin);
    Commands commands(device_);
    if (auto begun = commands.begin(); !begun) return begun;
    commands.update(from_, std::as_bytes(std::span(&from, 1)));
    dispatch(commands);
    return commands.submitAndWait();
}

} // namespace brittle
