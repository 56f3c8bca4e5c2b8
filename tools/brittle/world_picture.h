// Pictures of a world: bodies in colors that tell them apart, the planes they lie on, the shadows that they cast there, and
// dust.
#pragma once

#include "engine/image_io.h"
#include "tools/brittle/motion_output.h"

#include <memory>

namespace cli {

class WorldPicture {
public:
    // As large as the scene's camera wants them. Errors: Device, where it cannot draw; BadInput, for more pixels than it has.
    static engine::Result<std::unique_ptr<WorldPicture>> create(const Spectacle& spectacle);
    virtual ~WorldPicture() = default;
    virtual engine::Result<engine::Picture> draw(const Moment& moment) = 0;
};

} // namespace cli
