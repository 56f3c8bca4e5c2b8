#include "modules/brittle/fracture/collider_pools.h"

#include "modules/brittle/fracture/fetch.h"
#include "shaders-spirv/shared/collider.h"

#include <algorithm>

namespace brittle {

static_assert(sizeof(ColliderFace) == sizeof(ColliderFaceRecord) && sizeof(ColliderPiece) == sizeof(ColliderRecord));

engine::Result<ColliderBuffers> ColliderBuffers::create(engine::Device& device, const Capacities& c) {
    ColliderBuffers made;
    if (c.collider_directions == 0) return made;
    struct Wanted {
        engine::Buffer ColliderBuffers::*buffer;
        VkDeviceSize bytes;
        const char* name;
    };
    const Wanted wanted[] = {
        {&ColliderBuffers::records, VkDeviceSize{c.colliders} * sizeof(ColliderRecord), "colliders"},
        {&ColliderBuffers::faces, VkDeviceSize{c.collider_faces} * sizeof(ColliderFaceRecord), "collider faces"},
        {&ColliderBuffers::vertices, VkDeviceSize{c.collider_vertices} * 16, "collider vertices"},
        {&ColliderBuffers::corners, VkDeviceSize{c.collider_corners} * 4, "collider corners"}};
    for (const Wanted& w : wanted) {
        auto buffer =
            engine::Buffer::create(device, std::max<VkDeviceSize>(w.bytes, 256), engine::BufferDomain::Device, 0, w.name);
        if (!buffer) return buffer.error();
        made.*w.buffer = std::move(*buffer);
    }
    return made;
}

namespace {

ColliderPiece pieceOf(const ColliderRecord& r) {
    return {r.range[0], r.range[1], r.range[2], r.range[3], r.info[0], r.info[1], r.info[2], r.info[3]};
}

ColliderFace faceOf(const ColliderFaceRecord& r) {
    return {{r.plane[0], r.plane[1], r.plane[2]},    r.plane[3], r.loop[0], r.loop[1], r.loop[2],
            static_cast<ColliderFaceKind>(r.loop[3])};
}

// Pairs come in the order of cells; by fragments they are easier to find.
std::vector<std::array<uint32_t, 2>> overlappingOf(const std::vector<uint32_t>& partings) {
    std::vector<std::array<uint32_t, 2>> pairs;
    for (size_t at = 0; at + PARTING_WORDS <= partings.size(); at += PARTING_WORDS)
        if (partings[at + 2] == 0) pairs.push_back({partings[at], partings[at + 1]});
    std::ranges::sort(pairs);
    return pairs;
}

} // namespace

engine::Result<ColliderSet> readColliders(engine::Device& device, const std::vector<uint32_t>& status, const EventBuffers& b,
                                          const ColliderPools& pools) {
    std::vector<ColliderRecord> records(status[COUNT_COLLIDERS]);
    std::vector<ColliderFaceRecord> faces(status[COUNT_COLLIDER_FACES]);
    std::vector<std::array<float, 4>> vertices(status[COUNT_COLLIDER_VERTICES]);
    std::vector<uint32_t> partings(size_t{PARTING_WORDS} * status[COUNT_PARTINGS]);
    ColliderSet set;
    set.corners.resize(status[COUNT_COLLIDER_CORNERS]);
    const Fetch wanted[] = {{pools.records, records.data(), sizeof(ColliderRecord) * records.size()},
                            {pools.faces, faces.data(), sizeof(ColliderFaceRecord) * faces.size()},
                            {pools.vertices, vertices.data(), 16 * vertices.size()},
                            {pools.corners, set.corners.data(), 4 * set.corners.size()},
                            {b.partings, partings.data(), 4 * partings.size()}};
    if (auto ok = fetch(device, wanted); !ok) return ok.error();
    for (const ColliderRecord& r : records)
        set.pieces.push_back(pieceOf(r));
    for (const ColliderFaceRecord& r : faces)
        set.faces.push_back(faceOf(r));
    for (const std::array<float, 4>& v : vertices)
        set.vertices.push_back({v[0], v[1], v[2]});
    set.overlapping = overlappingOf(partings);
    return set;
}

} // namespace brittle
