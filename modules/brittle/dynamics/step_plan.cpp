#include "modules/brittle/dynamics/step_plan.h"

#include "modules/brittle/dynamics/count_names.h"

#include <algorithm>

namespace brittle {
namespace {

using engine::BufferView;
using engine::TracedCommand;

constexpr std::string_view kSizes[] = {"lanes",        "groups",    "a lane each", "a block each",
                                       "a group each", "arguments", "fill",        "copy"};

bool holds(const BufferView& range, const BufferView& view) {
    return range.buffer != nullptr && range.buffer == view.buffer && view.offset >= range.offset &&
           view.offset < range.offset + range.size;
}

class Planner {
public:
    explicit Planner(const PlannedMemory& memory) : memory_(memory) {}

    Pass passOf(const TracedCommand& command) const {
        Pass pass;
        pass.stage = command.label;
        pass.count = command.count;
        setSize(command, pass);
        if (command.kernel == nullptr) return withTransfers(command, std::move(pass));
        pass.kernel = command.kernel->name;
        pass.constants = constantsOf(*command.kernel);
        for (size_t k = 0; k < command.buffers.size(); k++) {
            const engine::ReflectedBinding& binding = command.kernel->reflection.bindings[k];
            const std::string slot = binding.name.substr(0, binding.name.rfind("_block"));
            pass.buffers.push_back({slot, nameOf(command.buffers[k]), !binding.writeonly, !binding.readonly});
        }
        return pass;
    }

private:
    // Of what holds the view, wherever in it the view begins.
    std::string nameOf(const BufferView& view) const {
        const auto found = std::ranges::find_if(
            memory_.named, [&](const NamedBuffer& named) { return named.bytes != 0 && holds(named.view, view); });
        return found == memory_.named.end() ? "" : found->name;
    }

    void setSize(const TracedCommand& command, Pass& pass) const {
        using Kind = TracedCommand::Kind;
        constexpr PassSize kKnown[] = {PassSize::Lanes, PassSize::Groups, PassSize::Arguments, PassSize::Fill, PassSize::Copy};
        pass.size = kKnown[static_cast<size_t>(command.kind)];
        if (command.kind != Kind::Indirect) return;
        pass.counted_by = nameOf(command.arguments);
        if (holds(memory_.args, command.arguments)) setCounted(command.arguments, memory_.args, &nameOfCount, pass);
        if (holds(memory_.fracture_args, command.arguments))
            setCounted(command.arguments, memory_.fracture_args, &nameOfFractureCount, pass);
    }

    // As Recorder lays arguments out: nine words a count, three of each kind.
    static void setCounted(const BufferView& arguments, const BufferView& all, std::string (*nameOf)(uint64_t), Pass& pass) {
        constexpr PassSize kEach[] = {PassSize::LaneEach, PassSize::BlockEach, PassSize::GroupEach};
        const uint64_t word = (arguments.offset - all.offset) / 4;
        pass.size = kEach[word % 9 / 3];
        pass.counted_by = nameOf(word / 9);
    }

    Pass withTransfers(const TracedCommand& command, Pass pass) const {
        const bool copies = command.kind == TracedCommand::Kind::Copy;
        pass.kernel = copies ? "copy" : "fill";
        if (copies) pass.buffers.push_back({"", nameOf(command.buffers[0]), true, false});
        pass.buffers.push_back({"", nameOf(command.buffers.back()), false, true});
        return pass;
    }

    // Those that the kernel declares.
    static std::vector<std::pair<std::string, uint32_t>> constantsOf(const engine::Kernel& kernel) {
        std::vector<std::pair<std::string, uint32_t>> constants;
        const engine::Reflection& reflection = kernel.reflection;
        for (size_t k = 0; k < reflection.spec_ids.size(); k++) {
            const auto set = std::ranges::find(kernel.constants, reflection.spec_ids[k], &engine::SpecConstant::id);
            if (set == kernel.constants.end()) continue;
            const bool is_size = reflection.local_size_ids[0] == set->id;
            constants.emplace_back(is_size ? "group_size" : reflection.spec_names[k], set->value);
        }
        return constants;
    }

    const PlannedMemory& memory_;
};

} // namespace

std::string_view nameOf(PassSize size) { return kSizes[static_cast<size_t>(size)]; }

uint64_t StepPlan::bytes() const {
    uint64_t sum = 0;
    for (const PlannedBuffer& buffer : buffers)
        sum += buffer.bytes;
    return sum;
}

uint64_t StepPlan::bytesOf(std::optional<Effect> effect) const {
    uint64_t sum = 0;
    for (const PlannedBuffer& buffer : buffers)
        if (buffer.asked_by == effect) sum += buffer.bytes;
    return sum;
}

Pass passOf(const TracedCommand& command, const PlannedMemory& memory) { return Planner(memory).passOf(command); }

StepPlan planOf(std::span<const TracedCommand> trace, const PlannedMemory& memory, std::vector<std::string> kernels) {
    StepPlan plan = {memory.effects, {}, {}, std::move(kernels)};
    const Planner planner(memory);
    for (const TracedCommand& command : trace)
        plan.passes.push_back(planner.passOf(command));
    for (const NamedBuffer& named : memory.named)
        plan.buffers.push_back({named.name, named.bytes, named.asked_by, named.is_shared});
    return plan;
}

} // namespace brittle
