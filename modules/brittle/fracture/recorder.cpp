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
    if (length.count == NO_INDEX) {
        uint32_t blocks = (length.known + SCAN_BLOCK - 1) / SCAN_BLOCK;
        if (blocks > 1) runGroups(first, blocks, reduce, {counts_, values, sums}); // the first block looks at no sums
        runGroups(second, blocks, apply, {counts_, values, sums, offsets, args_});
    } else {
        runGroups(first, blocksOf(length.count), reduce, {counts_, values, sums});
        runGroups(second, blocksOf(length.count), apply, {counts_, values, sums, offsets, args_});
    }
}

void Recorder::clear(Views views) {
    for (const engine::BufferView& view : views)
        commands_.fill(view, 0);
}

void Recorder::publish(uint32_t count, uint32_t capacity) {
    struct Push {
        uint32_t count, capacity;
    } push = {count, capacity};
    runGroups("publish_count", 1, push, {counts_, args_});
}

void Recorder::compact(Length length, engine::BufferView offsets, engine::BufferView list) {
    struct Push {
        uint32_t length, length_count;
    } push = {length.known, length.count};
    run("compact", length, push, {counts_, offsets, list});
}

} // namespace brittle
