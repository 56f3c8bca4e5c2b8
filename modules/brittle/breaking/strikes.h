// Blows by hand (shaders-spirv/shared/strike.h): which bodies a host strikes, and which of them that breaks. Only steps in
// which a host strikes have any of it: they are recorded apart, and what this needs is made when it is first asked for.
#pragma once

#include "modules/brittle/breaking/breaking_buffers.h"
#include "modules/brittle/breaking/hand_blow.h"
#include "modules/brittle/dynamics/step.h"
#include "shaders-spirv/shared/strike.h"

#include <memory>
#include <span>

namespace brittle {

class Strikes {
public:
    // For a world of so many slots of bodies and pieces. Errors: Capacity for what the device cannot bind; Device.
    static engine::Result<std::unique_ptr<Strikes>> create(engine::Device& device, uint32_t bodies, uint32_t pieces);

    // Once contacts are known, and before it is decided who sleeps. At most MOST_STRIKES.
    void recordJudging(const Step& step, const LastingBuffers& lasting, std::span<const HandBlow> blows) const;
    // Between the contacts' blows being found and being chosen; after they have been chosen.
    void recordRaising(const Step& step, const PassingBuffers& passing) const;
    void recordChoice(const Step& step, const PassingBuffers& passing) const;
    engine::BufferView records() const { return records_; }

private:
    explicit Strikes(engine::Device& device) : device_(device) {}
    engine::Result<void> make(uint64_t bodies, uint64_t pieces);

    engine::Device& device_;
    engine::Buffer strikes_, distances_, nearest_, claims_, reached_, records_;
};

} // namespace brittle
