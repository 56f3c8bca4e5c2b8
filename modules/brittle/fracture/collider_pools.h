// The pools that colliders go to, on the device, and how they come from there.
#pragma once

#include "engine/buffer.h"
#include "modules/brittle/collision/collider.h"
#include "modules/brittle/fracture/pools.h"

namespace brittle {

struct ColliderPools {
    engine::BufferView records, faces, vertices, corners;
};

struct ColliderBuffers {
    engine::Buffer records, faces, vertices, corners;

    // Nothing at all where no colliders were asked for.
    static engine::Result<ColliderBuffers> create(engine::Device& device, const Capacities& capacity);
    ColliderPools views() const { return {records, faces, vertices, corners}; }
};

// `status`: words of counts and status, of an event that finished.
engine::Result<ColliderSet> readColliders(engine::Device& device, const std::vector<uint32_t>& status, const EventBuffers& b,
                                          const ColliderPools& pools);

} // namespace brittle
