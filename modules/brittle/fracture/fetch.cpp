#include "modules/brittle/fracture/fetch.h"

#include "engine/commands.h"

#include <cstring>

namespace brittle {

engine::Result<void> fetch(engine::Device& device, std::span<const Fetch> wanted) {
    VkDeviceSize total = 16;
    for (const Fetch& p : wanted)
        total += (p.bytes + 15) / 16 * 16;
    auto buffer = engine::Buffer::create(device, total, engine::BufferDomain::Readback, 0, "readback");
    if (!buffer) return buffer.error();
    engine::Commands commands(device);
    if (auto ok = commands.begin(); !ok) return ok;
    VkDeviceSize at = 0;
    for (const Fetch& p : wanted) {
        if (p.bytes != 0) commands.copy(p.source.sub(0, p.bytes), engine::BufferView(*buffer).sub(at, p.bytes));
        at += (p.bytes + 15) / 16 * 16;
    }
    if (auto ok = commands.submitAndWait(); !ok) return ok;
    device.countReadBack(at);
    at = 0;
    for (const Fetch& p : wanted) {
        if (p.bytes != 0) std::memcpy(p.target, buffer->mapped() + at, p.bytes);
        at += (p.bytes + 15) / 16 * 16;
    }
    return {};
}

} // namespace brittle
