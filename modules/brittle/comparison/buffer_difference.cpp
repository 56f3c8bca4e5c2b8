#include "modules/brittle/comparison/buffer_difference.h"

#include "engine/buffer_values.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <unordered_map>

namespace brittle {
namespace {

using Bytes = std::span<const std::byte>;

Bytes elementOf(Bytes bytes, uint64_t element, uint32_t size) { return bytes.subspan(element * size, size); }

bool areEqual(Bytes a, Bytes b) { return std::memcmp(a.data(), b.data(), a.size()) == 0; }

std::string_view textOf(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

bool isChanged(const BufferContents& contents, uint64_t element, uint32_t size) {
    return !areEqual(elementOf(contents.before, element, size), elementOf(contents.after, element, size));
}

// Takes elements with equal contents out of both lists.
void leaveUnmatched(const BufferContents& a, const BufferContents& b, uint32_t size, ElementMatch& match) {
    std::unordered_map<std::string_view, std::vector<uint64_t>> of_b;
    for (size_t k = match.only_b.size(); k-- > 0;)
        of_b[textOf(elementOf(b.after, match.only_b[k], size))].push_back(match.only_b[k]);
    std::vector<uint64_t> left_a;
    for (const uint64_t element : match.only_a) {
        const auto found = of_b.find(textOf(elementOf(a.after, element, size)));
        if (found == of_b.end() || found->second.empty())
            left_a.push_back(element);
        else
            found->second.pop_back();
    }
    match.moved = match.only_a.size() - left_a.size();
    match.only_a = std::move(left_a);
    match.only_b.clear();
    for (const auto& [text, elements] : of_b)
        match.only_b.insert(match.only_b.end(), elements.begin(), elements.end());
    std::ranges::sort(match.only_b);
}

size_t equalWords(Bytes a, Bytes b) {
    size_t equal = 0;
    for (size_t at = 0; at + 4 <= a.size(); at += 4)
        equal += std::memcmp(a.data() + at, b.data() + at, 4) == 0 ? 1 : 0;
    return equal;
}

// The element that an element of A is compared with: the most like it, and of several the one at the same place.
uint64_t partnerOf(uint64_t element, const ElementMatch& match, Bytes a, Bytes b, uint32_t size) {
    constexpr size_t kMostTried = 4096;
    if (match.only_b.empty()) return element;
    const bool is_there = std::ranges::binary_search(match.only_b, element);
    uint64_t best = is_there ? element : match.only_b[0];
    size_t most = is_there ? equalWords(elementOf(a, element, size), elementOf(b, element, size)) : 0;
    for (size_t k = 0; k < std::min(match.only_b.size(), kMostTried); ++k) {
        const size_t equal = equalWords(elementOf(a, element, size), elementOf(b, match.only_b[k], size));
        if (equal <= most) continue;
        best = match.only_b[k];
        most = equal;
    }
    return best;
}

uint32_t firstOtherWord(Bytes a, Bytes b) {
    uint32_t at = 0;
    while (at + 4 < a.size() && std::memcmp(a.data() + at, b.data() + at, 4) == 0)
        at += 4;
    return at;
}

ValueDifference valueAt(const CapturedBuffer& a, const CapturedBuffer& b, uint64_t byte_a, uint64_t byte_b) {
    const auto place = engine::numberAt(a.fields, byte_a);
    const std::string type = place ? place->scalar : "uint";
    const uint64_t size = place ? place->bytes : 4, back = place ? byte_a - place->byte : 0;
    const Bytes of_a = Bytes(a.after).subspan(byte_a - back, size), of_b = Bytes(b.after).subspan(byte_b - back, size);
    ValueDifference value;
    value.member = place ? place->path : "word[" + std::to_string(byte_a / 4) + "]";
    value.type = type;
    value.a = engine::valueText(type, of_a);
    value.b = engine::valueText(type, of_b);
    value.bits_a = engine::valueText("bits", of_a);
    value.bits_b = engine::valueText("bits", of_b);
    return value;
}

} // namespace

ElementMatch matchElements(const BufferContents& a, const BufferContents& b, uint32_t element_bytes) {
    ElementMatch match;
    const uint64_t elements = std::min(a.after.size(), b.after.size()) / element_bytes;
    for (uint64_t k = 0; k < elements; ++k) {
        if (!isChanged(a, k, element_bytes) && !isChanged(b, k, element_bytes)) continue;
        ++match.written;
        if (areEqual(elementOf(a.after, k, element_bytes), elementOf(b.after, k, element_bytes))) continue;
        match.only_a.push_back(k);
        match.only_b.push_back(k);
    }
    leaveUnmatched(a, b, element_bytes, match);
    return match;
}

std::optional<ValueDifference> firstDifference(const ElementMatch& match, const CapturedBuffer& a, const CapturedBuffer& b) {
    if (match.only_a.empty()) return std::nullopt;
    const uint32_t size = engine::elementBytes(a.fields);
    const uint64_t element_a = match.only_a[0], element_b = partnerOf(element_a, match, a.after, b.after, size);
    const uint32_t at = firstOtherWord(elementOf(a.after, element_a, size), elementOf(b.after, element_b, size));
    ValueDifference value = valueAt(a, b, element_a * size + at, element_b * size + at);
    value.element_a = element_a;
    value.element_b = element_b;
    return value;
}

} // namespace brittle
