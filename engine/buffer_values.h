// The words of a buffer as the kernel that binds it understands them: which member of which element, and its value.
#pragma once

#include "engine/reflection.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace engine {

struct NumberPlace {
    std::string path;   // "bodies[12].offset.y"
    std::string scalar; // "float", "uint", "int", "double", "uint64", ...
    uint64_t byte = 0;  // where the number begins
    uint32_t bytes = 4; // its size
};

// The number that holds byte `byte` of a buffer whose block has these fields. Nothing for padding, and for a byte behind the
// block.
std::optional<NumberPlace> numberAt(std::span<const ReflectedField> fields, uint64_t byte);

// Bytes of an element: the stride of the array without a count that all fields of the block lie in, if it begins the block.
// Otherwise 4: the buffer is taken as a list of words.
uint32_t elementBytes(std::span<const ReflectedField> fields);

// A number of this type as text, with as many digits as it takes to tell it from its neighbors. `bytes`: as many as the type
// has. Types that are not known are shown as hexadecimal words.
std::string valueText(const std::string& scalar, std::span<const std::byte> bytes);

} // namespace engine
