#include "tests/support/world_mover.h"

#include "modules/brittle/dynamics/scene_settings.h"

namespace support {

engine::Result<std::unique_ptr<WorldMover>> WorldMover::make(engine::Device& device, const brittle::SceneDescription& scene,
                                                             const brittle::WorldContents& contents) {
    const auto settings = brittle::settingsOf(scene);
    if (!settings) return settings.error();
    auto world = brittle::World::create(device, contents, *settings, brittle::budgetOf(scene));
    if (!world) return world.error();
    return std::unique_ptr<WorldMover>(new WorldMover(std::move(*world), scene.step.dt / scene.step.substeps));
}

} // namespace support
