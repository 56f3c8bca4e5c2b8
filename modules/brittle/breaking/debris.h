// Debris. With the effect `debris_lifetime`, fragments below a size whose center of mass has been at rest for a time fade and
// leave the world. With `debris_room`, fragments at rest leave it at once where room for fragments runs short: the smallest
// first, of those about as large the oldest. They give back what they had of the pools, as what breaks does. What rested on
// them wakes. Bodies of the scene stay, however small they are.
#pragma once

#include "modules/brittle/breaking/adopt.h"
#include "modules/brittle/breaking/world_pools.h"
#include "modules/brittle/dynamics/step.h"
#include "shaders-spirv/shared/debris.h"

#include <memory>
#include <span>

namespace brittle {

struct DebrisRoom {
    uint32_t bodies = 0;          // slots of the world
    uint32_t least_fragments = 0; // room is made for `enough_fragments` if there is room for fewer
    uint32_t enough_fragments = 0;
    uint32_t kept_for_each = 0; // fragments beside these, for each body of the scene that has not broken yet
    uint32_t most_whole = 0;    // such bodies when the world begins
};

// The ring of BreakEvents, and how many were written so far.
struct BreakEvents {
    engine::BufferView told, ring;
};

class Debris {
public:
    // Errors: Device.
    static engine::Result<std::unique_ptr<Debris>> create(engine::Device& device, const DebrisRoom& room, EffectSet effects);

    // At the end of a step, after what broke has taken its ranges: what is returned now is taken in the next one at the
    // earliest, so that nobody finds contacts of who had a slot before. `room`: for MOST_EXPIRING ranges returned in a step.
    // `events`: empty without the effect `events`.
    void record(const Step& step, const BreakableWorld& world, const PoolRoom& room, const PoolBuffers& pools,
                const BreakEvents& events) const;

    // How much is left of each fragment, from 1 down to 0, by slot, of the first so many.
    engine::Result<std::vector<float>> fades(uint32_t slots, const StepSettings& settings) const;
    std::vector<engine::BufferView> stateViews() const { return {clocks_}; }
    engine::BufferView clocks() const { return clocks_; }
    std::vector<NamedBuffer> named() const;

private:
    Debris(engine::Device& device, const DebrisRoom& room, EffectSet effects)
        : device_(device), room_(room),
          asked_by_(effects.has(Effect::DebrisLifetime) ? Effect::DebrisLifetime : Effect::DebrisRoom) {}
    engine::Result<void> make();
    void recordAging(const Step& step, const BreakableWorld& world) const;
    void recordLeaving(const Step& step, const BreakableWorld& world, const PoolBuffers& pools) const;
    engine::BufferView argumentsAt(uint32_t word) const { return engine::BufferView(words_).sub(4 * word, 12); }

    engine::Device& device_;
    DebrisRoom room_;
    Effect asked_by_;
    engine::Buffer clocks_, words_, leaving_, returned_;
};

} // namespace brittle
