// Blows by hand (shaders-spirv/shared/strike.h): which bodies a host strikes, and which of them that breaks.
//
// A world has none of this before a host strikes for the first time. From then on each step raises the blows that wait: a step
// breaks as many bodies as it has room for, and the others break in the steps after. Only steps in which a host strikes judge
// new blows; they are recorded apart.
#pragma once

#include "modules/brittle/breaking/breaking_buffers.h"
#include "modules/brittle/breaking/hand_blow.h"
#include "modules/brittle/dynamics/step.h"
#include "shaders-spirv/shared/strike.h"

#include <memory>
#include <vector>

namespace brittle {

// What a host strikes with in one step.
struct HandBlows {
    std::vector<HandBlow> blows; // at most MOST_STRIKES
    bool is_first = false;       // of a world: the step begins with clearing what waits
};

class Strikes {
public:
    // `bodies` and `pieces`: slots of the world. The next step that is made has to have blows, and they are its first
    // ones: memory is not cleared before. Errors: Capacity for what the device cannot bind; Device.
    static engine::Result<std::unique_ptr<Strikes>> create(engine::Device& device, uint32_t bodies, uint32_t pieces);

    // Once contacts are known, and before it is decided who sleeps.
    void recordJudging(const Step& step, const LastingBuffers& lasting, const HandBlows& by_hand) const;
    // Both are of every step: one between finding and choosing the contacts' blows, one after they have been chosen.
    void recordRaising(const Step& step, const LastingBuffers& lasting, const PassingBuffers& passing) const;
    void recordChoice(const Step& step, const PassingBuffers& passing) const;
    // No blow waits any more. Errors: Device.
    engine::Result<void> forget();
    engine::BufferView records() const { return records_; }

private:
    explicit Strikes(engine::Device& device) : device_(device) {}
    engine::Result<void> make(uint64_t bodies, uint64_t pieces);

    engine::Device& device_;
    engine::Buffer strikes_, distances_, nearest_, claims_, reached_, records_;
};

} // namespace brittle
