// How the contents of one buffer differ between two devices after the same pass.
#pragma once

#include "modules/brittle/comparison/step_capture.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace brittle {

// A buffer before and after a pass. Both have as many bytes.
struct BufferContents {
    std::span<const std::byte> before, after;
};

// Elements that a pass wrote on one device or on both, compared byte by byte. An element that stands in another place on the
// other device is no difference: such lists are filled in the order in which lanes happen to run.
struct ElementMatch {
    std::vector<uint64_t> only_a, only_b; // indices of elements without an equal one on the other device, ascending
    uint64_t written = 0;                 // elements that either device changed
    uint64_t moved = 0;                   // elements that have an equal one in another place
};
ElementMatch matchElements(const BufferContents& a, const BufferContents& b, uint32_t element_bytes);

// One number that two devices have different values of.
struct ValueDifference {
    uint64_t element_a = 0, element_b = 0; // indices; they differ if the list has another order
    std::string member;                    // "bodies[12].offset.y", in the order of device A; "word[7]" without a struct
    std::string type;                      // "float", "uint", ...
    std::string a, b;                      // values as text
    std::string bits_a, bits_b;            // the same as hexadecimal words
};

// The first difference that `match` knows of. The element of device A is compared with the one in its place or, if that one is
// no difference, with the most similar one. Nothing if `match` has none.
std::optional<ValueDifference> firstDifference(const ElementMatch& match, const CapturedBuffer& a, const CapturedBuffer& b);

} // namespace brittle
