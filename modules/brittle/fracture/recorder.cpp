#include "modules/brittle/fracture/recorder.h"

#include "modules/brittle/fracture/deciding_kernels.h"

namespace brittle {

const engine::Kernel* Recorder::find(std::string_view name, uint32_t spec) {
    auto kernel = kernelFor(kernels_, name, spec, precision_);
    if (kernel) return *kernel;
    if (!error_) error_ = kernel.error();
    return nullptr;
}

engine::Result<void> Recorder::status() const {
    if (error_) return *error_;
    return commands_.status();
}

void Recorder::scan(Length length, engine::BufferView values, engine::BufferView sums, engine::BufferView offsets,
                    const Published& published, bool four_channels) {
    struct ReducePush {
        uint32_t length, length_count;
    } reduce = {length.known, length.count};
    struct ApplyPush {
        uint32_t length, length_count, pad[2];
        Published published;
    } apply = {length.known, length.count, {0, 0}, published};
    std::string_view first = four_channels ? "scan_reduce4" : "scan_reduce",
                     second = four_channels ? "scan_apply4" : "scan_apply";
    const bool many_blocks = length.most > SCAN_BLOCK; // the first one looks at no sums
    if (length.count == NO_INDEX) {
        const uint32_t blocks = (length.known + SCAN_BLOCK - 1) / SCAN_BLOCK;
        if (many_blocks) runGroups(first, blocks, reduce, {counts_, values, sums});
        runGroups(second, blocks, apply, {counts_, values, sums, offsets, args_});
    } else {
        if (many_blocks) runGroups(first, blocksOf(length.count), reduce, {counts_, values, sums});
        runGroups(second, blocksOf(length.count), apply, {counts_, values, sums, offsets, args_});
    }
}

void Recorder::sort(uint32_t count, uint32_t bits, const engine::BufferView (&keys)[2], const engine::BufferView (&values)[2],
                    const RadixBuffers& room) {
    uint32_t passes = (bits + RADIX_BITS - 1) / RADIX_BITS;
    passes += passes % 2; // so that the outcome lies where it began
    runGroups("publish_tiles", 1, count, {counts_, args_});
    for (uint32_t pass = 0; pass < passes; pass++) {
        struct Push {
            uint32_t length_count, shift;
        } push = {count, pass * RADIX_BITS};
        uint32_t from = pass % 2, to = 1 - from;
        runGroups("radix_count", blocksOf(count), push, {counts_, keys[from], room.histogram});
        scan(Length::counted(COUNT_RADIX), room.histogram, room.sums, room.digit_offsets, {});
        runGroups("radix_scatter", blocksOf(count), push,
                  {counts_, keys[from], values[from], room.digit_offsets, keys[to], values[to]});
    }
}

void Recorder::clear(Views views) {
    for (const engine::BufferView& view : views)
        if (is_gated_)
            runGroups("clear_words", groupsOf(COUNT_CLEARING), static_cast<uint32_t>(view.size / 16), {view});
        else
            commands_.fill(view, 0);
}

void Recorder::publish(uint32_t count, uint32_t capacity) {
    struct Push {
        uint32_t count, capacity;
    } push = {count, capacity};
    runGroups("publish_count", 1, push, {counts_, args_});
}

void Recorder::publishSum(uint32_t count, uint32_t capacity, std::initializer_list<Term> terms) {
    struct Push {
        uint32_t count, capacity, pad[2];
        std::array<uint32_t, 4> terms, weights;
    } push = {count, capacity, {0, 0}, {NO_INDEX, NO_INDEX, NO_INDEX, NO_INDEX}, {0, 0, 0, 0}};
    size_t k = 0;
    for (const Term& term : terms) {
        push.terms.at(k) = term.count;
        push.weights.at(k++) = term.times;
    }
    runGroups("publish_sum", 1, push, {counts_, args_});
}

void Recorder::compact(Length length, engine::BufferView offsets, engine::BufferView list) {
    struct Push {
        uint32_t length, length_count;
    } push = {length.known, length.count};
    run("compact", length, push, {counts_, offsets, list});
}

} // namespace brittle
