// One fracture event, recorded up to a stage by the module's own functions, so that every kernel is seen with the buffers and
// push blocks that it gets in earnest. All buffers of the event can be read back.
#pragma once

#include "modules/brittle/fracture/event.h"
#include "modules/brittle/fracture/scene_buffers.h"
#include "modules/brittle/mesh/prepare.h"
#include "tests/kernel/lab.h"
#include "tests/reference/geometry.h"

namespace kernel_test {

enum class Until { Sites, Cells, Classification, Clipping, Places, Depth, Caps, Islands, MassProperties, Emission };

brittle::PreparedMesh solidOf(const brittle::ImportedMesh& imported);
brittle::PreparedMesh solidOf(const reference::Triangles& triangles);
// "ring", "cube", "bumpy:2"... as brittle::makeBuiltin names them.
brittle::PreparedMesh solidOf(std::string_view builtin);

// 4 x 4 x 4 sites around the origin.
brittle::FractureOptions latticeSites(double apart);

class DeviceEvent {
public:
    // Pools that were too small are grown and the event is recorded again. What still is amiss afterwards fails the test.
    DeviceEvent(const brittle::PreparedMesh& solid, const brittle::FractureOptions& options, Until until);

    const brittle::EventBuffers& buffers() const { return buffers_; }
    const brittle::ScenePools& scene() const { return pools_; }
    const brittle::EventGrid& grid() const { return grid_; }
    const brittle::Mesh& mesh() const { return solid_.mesh; }
    const brittle::MeshTopology& topology() const { return solid_.topology; }
    uint32_t operator[](uint32_t count_or_status) const { return words_[count_or_status]; }
    uint32_t vertexCount() const { return static_cast<uint32_t>(solid_.mesh.positions.size()); }
    uint32_t triangleCount() const { return static_cast<uint32_t>(solid_.mesh.triangles.size()); }
    uint32_t edgeCount() const { return static_cast<uint32_t>(solid_.topology.edges.size()); }

    template <class T>
    std::vector<T> read(engine::BufferView view, size_t count) const {
        const engine::Buffer target = blankBuffer<T>(count);
        const VkDeviceSize bytes = count * sizeof(T);
        if (bytes == 0) return {};
        onDevice(
            [&](engine::Commands& commands) { commands.copy(view.sub(0, bytes), engine::BufferView(target).sub(0, bytes)); });
        return valuesOf<T>(target, count);
    }

    // On the grid, rounded by the host.
    std::vector<reference::GridPoint> vertices() const;
    reference::Triangles triangles() const;
    // By id, as place_sites and the welding left them.
    std::vector<reference::GridPoint> sites() const;

private:
    void prepare();
    void recordOnce(Until until);
    void upload(engine::Commands& commands, engine::Buffer& staging) const;
    void clear(engine::Commands& commands) const;

    brittle::PreparedMesh solid_;
    brittle::FractureOptions options_;
    std::vector<brittle::Double3> local_sites_;
    brittle::EventGrid grid_;
    brittle::TriangleColumns columns_;
    brittle::Capacities capacity_;
    std::optional<engine::ScratchArena> arena_;
    std::optional<brittle::SceneBuffers> scene_buffers_;
    brittle::EventBuffers buffers_;
    brittle::ScenePools pools_;
    std::vector<uint32_t> words_;
};

} // namespace kernel_test
