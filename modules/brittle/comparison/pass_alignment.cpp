#include "modules/brittle/comparison/pass_alignment.h"

#include <algorithm>

namespace brittle {
namespace {

using Keys = std::span<const std::string>;
using Pairs = std::vector<std::pair<uint32_t, uint32_t>>;

// Lengths of the longest common subsequences of all pairs of tails.
std::vector<std::vector<uint32_t>> commonLengths(Keys a, Keys b) {
    std::vector<std::vector<uint32_t>> lengths(a.size() + 1, std::vector<uint32_t>(b.size() + 1));
    for (size_t i = a.size(); i-- > 0;)
        for (size_t j = b.size(); j-- > 0;)
            lengths[i][j] = a[i] == b[j] ? lengths[i + 1][j + 1] + 1 : std::max(lengths[i + 1][j], lengths[i][j + 1]);
    return lengths;
}

void addCommon(Keys a, Keys b, uint32_t first, Pairs& pairs) {
    const auto lengths = commonLengths(a, b);
    for (uint32_t i = 0, j = 0; i < a.size() && j < b.size();) {
        if (a[i] == b[j])
            pairs.emplace_back(first + i++, first + j++);
        else
            lengths[i + 1][j] >= lengths[i][j + 1] ? ++i : ++j;
    }
}

std::vector<std::string> keysOf(const StepCapture& capture) {
    std::vector<std::string> keys;
    for (const CapturedPass& captured : capture)
        keys.push_back(keyOf(captured.pass));
    return keys;
}

} // namespace

std::string keyOf(const Pass& pass) {
    constexpr std::string_view kWide = "_wide";
    std::string key = pass.stage + "/" + pass.kernel;
    if (key.ends_with(kWide)) key.resize(key.size() - kWide.size());
    for (const PassBuffer& buffer : pass.buffers)
        key += "/" + buffer.slot + "=" + buffer.buffer;
    return key;
}

// Equal beginnings and ends are left out of the search, whose cost is the product of both lengths.
Pairs alignKeys(Keys a, Keys b) {
    const size_t most = std::min(a.size(), b.size());
    size_t head = 0, tail = 0;
    while (head < most && a[head] == b[head])
        ++head;
    while (tail < most - head && a[a.size() - 1 - tail] == b[b.size() - 1 - tail])
        ++tail;
    Pairs pairs;
    for (uint32_t k = 0; k < head; ++k)
        pairs.emplace_back(k, k);
    addCommon(a.subspan(head, a.size() - head - tail), b.subspan(head, b.size() - head - tail), static_cast<uint32_t>(head),
              pairs);
    for (size_t k = tail; k > 0; --k)
        pairs.emplace_back(static_cast<uint32_t>(a.size() - k), static_cast<uint32_t>(b.size() - k));
    return pairs;
}

Pairs alignPasses(const StepCapture& a, const StepCapture& b) { return alignKeys(keysOf(a), keysOf(b)); }

} // namespace brittle
