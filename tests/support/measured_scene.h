// A scene that Brittle or another engine moves, and what can be measured of it in double precision; free of any test's
// framework.
#pragma once

#include "modules/brittle/dynamics/scene_contents.h"
#include "tests/reference/boxes.h"
#include "tests/support/body_overlaps.h"
#include "tests/support/mover.h"

#include <memory>
#include <utility>
#include <vector>

namespace support {

// m. How far apart points may be to count as contacts: 2 cm at 60 steps a second if the scene does not say.
double marginOf(const brittle::StepDescription& step);

class MeasuredScene {
public:
    explicit MeasuredScene(brittle::SceneDescription scene) : scene_(std::move(scene)) {}

    // Once, before all else. `make_mover` makes the mover; without one it is a world on the device. Errors: those of fracture,
    // of contents, of worlds and of the mover.
    engine::Result<void> make(engine::Device& device, const MakeMover& make_mover = {});
    engine::Result<void> advance(uint32_t steps); // and reads the bodies
    uint32_t stepsLeft() const { return scene_.step.steps - made_; }

    const brittle::SceneDescription& scene() const { return scene_; }
    brittle::World& world() { return *world_; }          // only where no other engine moves the scene
    double substep() const { return mover_->substep(); } // see Mover
    size_t bodyCount() const { return now_.size(); }
    bool moves(size_t body) const { return now_[body].offset.w != 0; }
    const gpu::BodyState& state(size_t body) const { return now_[body]; }
    brittle::Double3 place(size_t body) const;
    brittle::Double3 way(size_t body) const; // since the beginning
    double speed(size_t body) const;
    double kineticEnergy(size_t body) const; // J

    // Over all bodies that move.
    double fastest() const;
    double furthestWay() const;
    double meanWay() const;
    double kineticEnergy() const;
    brittle::Double3 momentum() const;
    brittle::Double3 angularMomentum() const; // about the origin of the world
    // Sums of the sizes of what each body has.
    double momentumInAll() const;
    double angularMomentumInAll() const;
    bool isFinite() const;
    // How deep pieces of different bodies lie in each other, the deepest last; pairs that do not overlap are left out.
    std::vector<double> overlaps() const;
    // Of each piece on its way in the last step, which was made alone, with the margin of the scene and so much more.
    std::vector<reference::SolidBox> sweptBoxes(double more) const;

private:
    engine::Result<void> makeWorld(engine::Device& device);

    brittle::SceneDescription scene_;
    brittle::WorldContents contents_;
    brittle::World* world_ = nullptr; // the mover's; none where another engine moves the scene
    std::unique_ptr<Mover> mover_;
    std::vector<gpu::BodyState> first_, last_, now_;
    uint32_t made_ = 0;
};

} // namespace support
