// Debris: fragments below a size whose center of mass has been at rest for a time fade and give back what they had of the
// pools, as what breaks does. What rested on them wakes. Bodies of the scene stay, however small they are.
#pragma once

#include "modules/brittle/breaking/adopt.h"
#include "modules/brittle/breaking/world_pools.h"
#include "modules/brittle/dynamics/step.h"
#include "shaders-spirv/shared/debris.h"

#include <memory>
#include <span>

namespace brittle {

class Debris {
public:
    // `bodies`: slots of the world. Errors: Device.
    static engine::Result<std::unique_ptr<Debris>> create(engine::Device& device, uint32_t bodies);

    // At the end of a step, after what broke has taken its ranges: what is returned now is taken in the next one at the
    // earliest, so that nobody finds contacts of who had a slot before. `room`: for MOST_EXPIRING ranges returned in a step.
    void record(const Step& step, const BreakableWorld& world, const PoolRoom& room, const PoolBuffers& pools) const;

    // How much is left of each fragment, from 1 down to 0, by slot, of the first so many.
    engine::Result<std::vector<float>> fades(uint32_t slots, const StepSettings& settings) const;
    std::vector<engine::BufferView> stateViews() const { return {clocks_}; }
    engine::BufferView clocks() const { return clocks_; }
    std::vector<NamedBuffer> named() const;

private:
    explicit Debris(engine::Device& device) : device_(device) {}
    engine::Result<void> make(uint32_t bodies);
    void recordAging(const Step& step, const BreakableWorld& world) const;
    engine::BufferView argumentsAt(uint32_t word) const { return engine::BufferView(words_).sub(4 * word, 12); }

    engine::Device& device_;
    engine::Buffer clocks_, words_, leaving_, returned_;
};

} // namespace brittle
