// Records kernels by name, over a number of lanes that the host knows or over a count that the device has published, and the
// two primitives that everything is made of: prefix sums and stable sorting.
#pragma once

#include "engine/commands.h"
#include "engine/kernel.h"
#include "modules/brittle/fracture/precision.h"
#include "shaders-spirv/shared/fracture.h"

#include <array>
#include <optional>
#include <string_view>

namespace brittle {

// What a scan makes of its totals: up to four counts, each with the capacity of its pool.
struct Published {
    std::array<uint32_t, 4> count = {NO_INDEX, NO_INDEX, NO_INDEX, NO_INDEX};
    std::array<uint32_t, 4> capacity = {NO_INDEX, NO_INDEX, NO_INDEX, NO_INDEX};
};

// How many elements: known to the host, or held by a count, of which the host may know the most that it can be.
struct Length {
    uint32_t known = 0;
    uint32_t count = NO_INDEX;
    uint32_t most = NO_INDEX;
    static Length of(uint32_t n) { return {n, NO_INDEX, n}; }
    static Length counted(uint32_t index, uint32_t most = NO_INDEX) { return {0, index, most}; }
};

// What a radix sort needs next to keys and values.
struct RadixBuffers {
    engine::BufferView histogram, digit_offsets, sums;
};

class Recorder {
public:
    using Views = std::initializer_list<engine::BufferView>;

    Recorder(engine::Commands& commands, engine::KernelLibrary& kernels, engine::BufferView counts, engine::BufferView args,
             Precision precision = Precision::Exact)
        : commands_(commands), kernels_(kernels), counts_(counts), args_(args), precision_(precision) {}

    template <class Push = engine::NoPush>
    void run(std::string_view name, Length length, const Push& push, Views buffers, uint32_t spec = 0) {
        const engine::Kernel* kernel = find(name, spec);
        if (kernel == nullptr) return;
        if (length.count == NO_INDEX)
            commands_.dispatch(*kernel, length.known, push, buffers);
        else
            commands_.dispatchIndirect(*kernel, lanesOf(length.count), push, buffers);
    }
    // A workgroup an element.
    template <class Push>
    void runGroups(std::string_view name, uint32_t groups, const Push& push, Views buffers) {
        if (is_gated_ && groups == 1) return runGroups(name, groupsOf(COUNT_EVENT), push, buffers);
        if (const engine::Kernel* kernel = find(name, 0)) commands_.dispatchGroups(*kernel, groups, push, buffers);
    }
    template <class Push>
    void runGroups(std::string_view name, engine::BufferView args, const Push& push, Views buffers) {
        if (const engine::Kernel* kernel = find(name, 0)) commands_.dispatchIndirect(*kernel, args, push, buffers);
    }

    // offsets[k] = values[0] + ... + values[k - 1]; one more offset than values. Four channels: values are uvec4.
    void scan(Length length, engine::BufferView values, engine::BufferView sums, engine::BufferView offsets,
              const Published& published, bool four_channels = false);
    // Sorts two lists by the low `bits` of the keys, stably; `count` says how long they are. The second pair of lists is room
    // to work in, the outcome lies in the first.
    void sort(uint32_t count, uint32_t bits, const engine::BufferView (&keys)[2], const engine::BufferView (&values)[2],
              const RadixBuffers& room);
    void clear(Views views);
    // From now on what is dispatched over no count, a workgroup or the clearing of a buffer, hangs on COUNT_EVENT and
    // COUNT_CLEARING: where the device has found nothing to do it costs as little as all else.
    void gate() { is_gated_ = true; }
    // Makes a count that kernels built with atomics known to dispatches.
    void publish(uint32_t count, uint32_t capacity);
    // Publishes a sum of up to four other counts, each so many times.
    struct Term {
        uint32_t count, times;
    };
    void publishSum(uint32_t count, uint32_t capacity, std::initializer_list<Term> terms);
    // list[...] = the elements where `offsets` steps up.
    void compact(Length length, engine::BufferView offsets, engine::BufferView list);

    // Dispatch arguments of a count: a lane an element, a workgroup SCAN_BLOCK elements, a workgroup an element.
    engine::BufferView lanesOf(uint32_t count) const { return args_.sub(36 * count, 12); }
    engine::BufferView blocksOf(uint32_t count) const { return args_.sub(36 * count + 12, 12); }
    engine::BufferView groupsOf(uint32_t count) const { return args_.sub(36 * count + 24, 12); }

    engine::Commands& commands() { return commands_; }
    engine::BufferView counts() const { return counts_; }
    engine::BufferView args() const { return args_; }
    engine::Result<void> status() const;

private:
    const engine::Kernel* find(std::string_view name, uint32_t spec);

    engine::Commands& commands_;
    engine::KernelLibrary& kernels_;
    engine::BufferView counts_;
    engine::BufferView args_;
    Precision precision_;
    bool is_gated_ = false;
    std::optional<engine::Error> error_;
};

} // namespace brittle
