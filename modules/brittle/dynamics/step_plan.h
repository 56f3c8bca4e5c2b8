// What a step of a world is made of: its passes in order, what each reads and writes, and which effect asked for which bytes.
#pragma once

#include "engine/commands.h"
#include "modules/brittle/dynamics/world_buffers.h"

#include <string>
#include <utility>
#include <vector>

namespace brittle {

// How many workgroups a pass has: known when it is recorded, or by a count that the device has published.
enum class PassSize : uint8_t { Lanes, Groups, LaneEach, BlockEach, GroupEach, Arguments, Fill, Copy };
std::string_view nameOf(PassSize size);

struct PassBuffer {
    std::string slot;   // as the kernel calls it; "" of fills and copies
    std::string buffer; // one of StepPlan::buffers
    bool reads = false, writes = false;
    bool operator==(const PassBuffer&) const = default;
};

struct Pass {
    std::string stage, kernel; // "fill" and "copy" are no kernels
    std::vector<std::pair<std::string, uint32_t>> constants;
    PassSize size = PassSize::Groups;
    uint32_t count = 0;     // lanes or workgroups, where they are known
    std::string counted_by; // the count, or the buffer with the arguments, where they are not
    std::vector<PassBuffer> buffers;
    bool operator==(const Pass&) const = default;

    bool isDispatch() const { return size != PassSize::Fill && size != PassSize::Copy; }
};

struct PlannedBuffer {
    std::string name;
    uint64_t bytes = 0;             // 0: a binding of this name is the dummy
    std::optional<Effect> asked_by; // none: every world has it
    bool is_shared = false;         // by lists of which one is done with before another begins: PassBuffer::slot tells which
    bool operator==(const PlannedBuffer&) const = default;
};

struct StepPlan {
    EffectSet effects;
    std::vector<Pass> passes;
    std::vector<PlannedBuffer> buffers;
    std::vector<std::string> kernels; // that are loaded

    uint64_t bytes() const;
    uint64_t bytesOf(std::optional<Effect> effect) const;
    bool operator==(const StepPlan&) const = default;
};

// All that commands of a step may name.
struct PlannedMemory {
    EffectSet effects;
    std::vector<NamedBuffer> named;
    engine::BufferView args, fracture_args; // of dispatches; of those of fracture, where there is any
};

// Is shown every pass of a step before and after the device runs it (World::probeStep). An error ends the step.
class PassProbe {
public:
    virtual ~PassProbe() = default;
    // `command`: the pass as it was recorded. The views of a dispatch are in the order of `pass.buffers`; the last view of a
    // fill or a copy is its target.
    virtual engine::Result<void> before(const Pass& pass, const engine::TracedCommand& command) = 0;
    virtual engine::Result<void> after(const Pass& pass, const engine::TracedCommand& command) = 0;
};

Pass passOf(const engine::TracedCommand& command, const PlannedMemory& memory);
StepPlan planOf(std::span<const engine::TracedCommand> trace, const PlannedMemory& memory, std::vector<std::string> kernels);

} // namespace brittle
