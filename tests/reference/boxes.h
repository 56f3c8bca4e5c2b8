// Pairs of boxes that meet, by holding each against each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace reference {

struct SolidBox {
    std::array<double, 3> low = {}, high = {};
    uint32_t body = 0;
    bool fixed = false;  // does not move
    bool absent = false; // is not there
};

// (a, b), a < b, in order: of different bodies, not both fixed, with no gap between them along any axis. A box that is inside
// out, or has a corner that is no number, meets nothing.
std::vector<std::array<uint32_t, 2>> pairsThatMeet(const std::vector<SolidBox>& boxes);

} // namespace reference
