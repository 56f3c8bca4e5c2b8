// Breaking, as a part of the step of a world (shaders-spirv/shared/breaking.h).
//
// Before contacts are solved it is known which of them break what they touch: these are left out of the solving, and bodies
// stop where they meet. When the step has ended, the bodies that were hit are broken by one event of fracture, their cracks are
// paid for by the motion of who met, and their fragments take their place. All of it is recorded once and dispatched by counts
// that the device finds out, 0 of them in a step in which nothing breaks.
#pragma once

#include "modules/brittle/breaking/room_to_break.h"
#include "modules/brittle/breaking/strikes.h"
#include "modules/brittle/dynamics/step.h"

#include <memory>
#include <optional>
#include <span>

namespace brittle {

// Checks that the device can bind the lists by which a body of `triangles` triangles breaks. Errors: Capacity, with the
// most triangles of a body that it can. The lists do not depend on bodies if the budget has triangles for a step.
engine::Result<void> canBreak(engine::Device& device, uint32_t triangles, const BreakingBudget& budget);

class Breaking {
public:
    // `contents` with room, as the world of that size has them. Errors: Capacity, with the list that the device cannot bind;
    // Device.
    static engine::Result<std::unique_ptr<Breaking>> create(engine::Device& device, const WorldContents& contents,
                                                            const RoomToBreak& room, const StepSettings& settings,
                                                            const WorldSizes& world, uint32_t group_size);
    virtual ~Breaking() = default;

    // Makes what blows by hand need. The world keeps it, also when it makes more room. Errors: Capacity, Device.
    virtual engine::Result<std::unique_ptr<Strikes>> makeStrikes() const = 0;
    // Records whom a host strikes in this step, before it is decided who sleeps.
    virtual void recordStrikes(const Step& step, const Strikes& strikes, const HandBlows& by_hand) const = 0;
    // `strikes`, here and below: nullptr before a host strikes for the first time.
    virtual engine::Result<void> recordBlows(const Step& step, const Strikes* strikes) = 0;
    // Who breaks, once nothing can fail any more that the step needs: a step that is not made breaks nothing. Bodies stand as
    // they did when it began.
    virtual void recordAdmission(const Step& step, const Strikes* strikes) = 0;
    virtual engine::Result<void> recordEvent(const Step& step) = 0;

    // Since `heard`, which is brought up to now.
    virtual engine::Result<Breaks> tell(uint32_t& heard) = 0;
    // All that the next step depends on, beside what the world has.
    virtual std::vector<engine::BufferView> stateViews() const = 0;
    // Memory whose contents a step makes before it reads them.
    virtual std::vector<engine::BufferView> stepMemory() const = 0;
    // All of its own, by name.
    virtual std::vector<NamedBuffer> buffers() const = 0;
    virtual engine::BufferView arguments() const = 0; // of the event's dispatches
    // SceneVertices, three a triangle, of all surfaces; gpu::BreakableBody, a body each.
    virtual engine::BufferView surfaceVertices() const = 0;
    virtual engine::BufferView breakable() const = 0;
    // gpu::DebrisClock, a body each; none without the effect `debris_lifetime`.
    virtual std::optional<engine::BufferView> clocks() const = 0;
    // What flies of all that was too small for a body; nothing without the effect `dust`.
    virtual engine::Result<Dust> dust() const = 0;
    // How much is left of each body, from 1 to 0, by slot, of the first so many; 1 without the effect `debris_lifetime`.
    virtual engine::Result<std::vector<float>> fades(uint32_t slots) const = 0;
    virtual engine::Result<std::array<gpu::PoolHeader, POOLS>> pools() const = 0;
};

} // namespace brittle
