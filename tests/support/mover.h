// Who moves the bodies of a measured scene: a Brittle world, or another engine that has the same bodies.
#pragma once

#include "modules/brittle/dynamics/scene_contents.h"

#include <functional>
#include <memory>
#include <vector>

namespace support {

class Mover {
public:
    virtual ~Mover() = default;

    virtual engine::Result<void> step(uint32_t steps) = 0; // of the scene's length
    // All bodies of the contents, in their order and in their frames.
    virtual engine::Result<std::vector<gpu::BodyState>> bodies() = 0;
    // s. Velocities change once in so much time: those of a falling body are half of it late.
    virtual double substep() const = 0;
};

// Errors: Feature, where this engine cannot move such a scene, with the reason.
using MakeMover = std::function<engine::Result<std::unique_ptr<Mover>>(const brittle::SceneDescription& scene,
                                                                       const brittle::WorldContents& contents)>;

// A place that no world can hold, beyond 1e6 m, becomes NaN; checks call such a body lost.
void moveTo(gpu::BodyState& state, const brittle::Double3& place);

} // namespace support
