// Numbers for positions: one for all corners at one place.
#pragma once

#include "modules/brittle/mesh/mesh.h"

#include <bit>
#include <vector>

namespace brittle {

// Open addressing over bit patterns; -0 and 0 are one.
class Welder {
public:
    explicit Welder(size_t expected) : slots_(std::bit_ceil(2 * expected + 2), kEmpty) {}

    uint32_t indexOf(Float3 p, std::vector<Float3>& positions) {
        for (float& x : p)
            x += 0.0f; // turns -0 into 0
        for (size_t slot = hash(p);; ++slot) {
            uint32_t& entry = slots_[slot & (slots_.size() - 1)];
            if (entry == kEmpty) {
                entry = static_cast<uint32_t>(positions.size());
                positions.push_back(p);
                return entry;
            }
            if (positions[entry] == p) return entry;
        }
    }

private:
    static constexpr uint32_t kEmpty = 0xffffffff;
    static size_t hash(const Float3& p) {
        uint64_t h = 0;
        for (const float x : p) {
            h = (h ^ std::bit_cast<uint32_t>(x)) * 0x9E3779B97F4A7C15u;
            h ^= h >> 29;
        }
        return h;
    }
    std::vector<uint32_t> slots_;
};

} // namespace brittle
