#include "tests/reference/boxes.h"

namespace reference {
namespace {

bool exists(const SolidBox& box) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!(box.low[axis] <= box.high[axis])) return false;
    return !box.absent;
}

bool meet(const SolidBox& a, const SolidBox& b) {
    if (a.body == b.body || (a.fixed && b.fixed)) return false;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (a.high[axis] < b.low[axis] || b.high[axis] < a.low[axis]) return false;
    return true;
}

} // namespace

std::vector<std::array<uint32_t, 2>> pairsThatMeet(const std::vector<SolidBox>& boxes) {
    std::vector<std::array<uint32_t, 2>> pairs;
    for (uint32_t a = 0; a < boxes.size(); ++a) {
        if (!exists(boxes[a])) continue;
        for (uint32_t b = a + 1; b < boxes.size(); ++b)
            if (exists(boxes[b]) && meet(boxes[a], boxes[b])) pairs.push_back({a, b});
    }
    return pairs;
}

} // namespace reference
