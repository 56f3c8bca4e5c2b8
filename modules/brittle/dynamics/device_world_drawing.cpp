// The buffers that a world is drawn from.
#include "modules/brittle/dynamics/device_world.h"

#include <cmath>

namespace brittle {

using engine::Error;
using engine::ErrorCode;
using engine::Result;

namespace {

Result<void> checkOrigin(const Double3& origin) {
    constexpr double kFarthest = 1e6; // m
    for (const double x : origin)
        if (!(std::abs(x) <= kFarthest))
            return Error{ErrorCode::BadInput, "the place that is drawn from has to be numbers, and no further out than 1e6 m"};
    return {};
}

} // namespace

Result<DrawBuffers> DeviceWorld::drawBuffers() {
    if (auto made = makeDrawing(); !made) return made.error();
    return drawing_->buffers();
}

Result<void> DeviceWorld::recordDraws(VkCommandBuffer commands, const Double3& origin) {
    if (auto sound = checkOrigin(origin); !sound) return sound;
    if (auto made = makeDrawing(); !made) return made;
    drawing_->record(commands, origin);
    return {};
}

Result<void> DeviceWorld::updateDraws(const Double3& origin) {
    if (auto sound = checkOrigin(origin); !sound) return sound;
    if (auto settled = settle(); !settled) return settled;
    if (auto made = makeDrawing(); !made) return made;
    return drawing_->update(origin);
}

Result<void> DeviceWorld::makeDrawing() {
    if (drawing_) return {};
    Drawing::Source source = {.bodies = b_.bodies, .slots = b_.sizes.bodies, .as_added = order_.body_at};
    if (breaking_) {
        source.breakable = breaking_->breakable();
        source.vertices = breaking_->surfaceVertices();
        source.clocks = breaking_->clocks();
        source.fades_after = static_cast<float>(settings_.debris_after);
        source.fade_duration = static_cast<float>(settings_.debris_fade);
    }
    auto made = Drawing::create(device_, kernels_, contents_, std::move(source), ++drawings_);
    if (!made) return made.error();
    drawing_ = std::move(*made);
    return {};
}

} // namespace brittle
