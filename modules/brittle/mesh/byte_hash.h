// A hash of 64 bits over bytes as they arrive: FNV-1a (Fowler, Noll and Vo).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace brittle {

class ByteHash {
public:
    void add(std::span<const std::byte> bytes) {
        for (const std::byte b : bytes)
            value_ = (value_ ^ static_cast<uint64_t>(b)) * 0x100000001b3u;
    }
    uint64_t value() const { return value_; }

private:
    uint64_t value_ = 0xcbf29ce484222325u;
};

} // namespace brittle
