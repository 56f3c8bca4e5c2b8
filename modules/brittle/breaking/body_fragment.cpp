#include "modules/brittle/breaking/body_fragment.h"

#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/fracture/fetch.h"

#include <algorithm>
#include <numeric>

namespace brittle {
namespace {

using engine::BufferView;
using engine::Result;

bool holdsFragment(const gpu::BreakableBody& body) { return body.surface.w != NO_INDEX && body.balance.w > 0; }

uint32_t vertexCount(const gpu::BreakableBody& body) { return body.surface.y + body.surface.z; }

void copy(const Double3& from, float* to) {
    const Float3 narrow = toFloat(from);
    std::ranges::copy(narrow, to);
}

FragmentVertex inOwnFrame(FragmentVertex vertex, const gpu::BreakableBody& body) {
    const Turn turn = {body.turn.x, body.turn.y, body.turn.z, body.turn.w};
    const Double3 balance = {body.balance.x, body.balance.y, body.balance.z};
    copy(turnedBy(turn, positionOf(vertex) - balance), vertex.position);
    copy(turnedBy(turn, toDouble({vertex.normal[0], vertex.normal[1], vertex.normal[2]})), vertex.normal);
    return vertex;
}

// `pool`: as on the device.
SurfaceMesh surfaceOf(const gpu::BreakableBody& body, std::span<const FragmentVertex> pool) {
    SurfaceMesh surface;
    for (const FragmentVertex& vertex : pool)
        surface.vertices.push_back(inOwnFrame(vertex, body));
    surface.indices.resize(pool.size());
    std::iota(surface.indices.begin(), surface.indices.end(), 0u);
    surface.outer_index_count = body.surface.y;
    return surface;
}

} // namespace

Result<std::vector<BodyFragment>> FragmentList::read(engine::Device& device, BufferView breakable, BufferView births,
                                                     uint32_t slots, uint32_t changes) {
    if (known_of_ == changes) return known_;
    std::vector<gpu::BreakableBody> records(slots);
    std::vector<gpu::Birth> born(slots);
    const Fetch wanted[] = {{breakable, records.data(), records.size() * sizeof(gpu::BreakableBody)},
                            {births, born.data(), born.size() * sizeof(gpu::Birth)}};
    if (auto read = fetch(device, wanted); !read) return read.error();
    known_.clear();
    for (uint32_t slot = 0; slot < slots; ++slot)
        if (holdsFragment(records[slot]))
            known_.push_back({slot, static_cast<uint32_t>(records[slot].balance.w), static_cast<uint32_t>(records[slot].low.w),
                              born[slot].of.x, born[slot].of.z, records[slot]});
    known_of_ = changes;
    return known_;
}

Result<std::vector<SurfaceMesh>> readSurfaces(engine::Device& device, BufferView vertices,
                                              std::span<const BodyFragment> fragments) {
    std::vector<std::vector<FragmentVertex>> pools;
    std::vector<Fetch> wanted;
    for (const BodyFragment& fragment : fragments) {
        auto& pool = pools.emplace_back(vertexCount(fragment.record));
        const size_t bytes = pool.size() * sizeof(FragmentVertex);
        wanted.push_back({vertices.sub(fragment.record.surface.x * sizeof(FragmentVertex), bytes), pool.data(), bytes});
    }
    if (auto read = fetch(device, wanted); !read) return read.error();
    std::vector<SurfaceMesh> surfaces;
    for (size_t k = 0; k < fragments.size(); ++k)
        surfaces.push_back(surfaceOf(fragments[k].record, pools[k]));
    return surfaces;
}

} // namespace brittle
