// A Brittle world as the mover of a scene.
#pragma once

#include "tests/support/mover.h"

namespace support {

class WorldMover : public Mover {
public:
    // Errors: those of settings and of worlds.
    static engine::Result<std::unique_ptr<WorldMover>> make(engine::Device& device, const brittle::SceneDescription& scene,
                                                            const brittle::WorldContents& contents);

    brittle::World& world() { return *world_; }
    engine::Result<void> step(uint32_t steps) override { return world_->step(steps); }
    engine::Result<std::vector<gpu::BodyState>> bodies() override { return world_->bodies(); }
    double substep() const override { return substep_; }

private:
    WorldMover(std::unique_ptr<brittle::World> world, double substep) : world_(std::move(world)), substep_(substep) {}

    std::unique_ptr<brittle::World> world_;
    double substep_;
};

} // namespace support
