// A plain window that shows a world as it is stepped.
#pragma once

#include "tools/brittle/simulation.h"

#include <memory>

namespace shader_reload {

class SceneWindow {
public:
    // `staged` with its surfaces, to which fragments are added. Errors: BadInput, where there is no screen or this program was
    // built without windows; Device, where the device cannot draw.
    static engine::Result<std::unique_ptr<SceneWindow>> open(engine::Device& device, cli::StagedScene& staged,
                                                             brittle::World& world);
    virtual ~SceneWindow() = default;

    virtual engine::Result<void> show() = 0; // the world as it is now
    virtual bool isClosed() const = 0;
};

} // namespace shader_reload
