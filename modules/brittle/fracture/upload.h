// Host data on its way into the scratch arena: gathered in one upload buffer, copied by the recorded commands.
#pragma once

#include "engine/buffer.h"
#include "engine/commands.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <vector>

namespace brittle {

class Upload {
public:
    template <class T>
    void add(std::span<const T> data, engine::BufferView target) {
        if (data.empty()) return;
        parts_.push_back({std::as_bytes(data), target, bytes_});
        bytes_ += (data.size_bytes() + 15) / 16 * 16;
    }

    // The filled buffer; it must outlive the execution of the copies, the data need not.
    engine::Result<engine::Buffer> stage(engine::Device& device) const {
        auto staging =
            engine::Buffer::create(device, std::max<VkDeviceSize>(bytes_, 16), engine::BufferDomain::Upload, 0, "upload");
        if (!staging) return staging;
        for (const Part& part : parts_)
            std::memcpy(staging->mapped() + part.offset, part.bytes.data(), part.bytes.size());
        return staging;
    }
    // All at once, and waits for it.
    engine::Result<void> send(engine::Device& device) const {
        const auto staging = stage(device);
        if (!staging) return staging.error();
        engine::Commands commands(device);
        if (auto begun = commands.begin(); !begun) return begun;
        copy(commands, *staging);
        return commands.submitAndWait();
    }
    void copy(engine::Commands& commands, const engine::Buffer& staging) const {
        for (const Part& part : parts_)
            commands.copy(engine::BufferView(staging).sub(part.offset, part.bytes.size()),
                          part.target.sub(0, part.bytes.size()));
    }

private:
    struct Part {
        std::span<const std::byte> bytes;
        engine::BufferView target;
        VkDeviceSize offset;
    };
    std::vector<Part> parts_;
    VkDeviceSize bytes_ = 0;
};

} // namespace brittle
