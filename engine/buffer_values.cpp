#include "engine/buffer_values.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <vector>

namespace engine {

namespace {

uint32_t scalarBytes(const std::string& scalar) {
    if (scalar == "double" || scalar.ends_with("64")) return 8;
    if (scalar.ends_with("16")) return 2;
    return scalar.ends_with("8") ? 1 : 4;
}

struct Rest {
    uint64_t byte = 0;              // in the element of the innermost array
    std::vector<uint64_t> elements; // of the arrays, from the innermost to the outermost
};

// Takes the index of every array away, from the outermost to the innermost.
std::optional<Rest> withoutArrays(const ReflectedField& field, uint64_t byte) {
    Rest rest = {byte, std::vector<uint64_t>(field.arrays.size())};
    for (size_t k = field.arrays.size(); k-- > 0;) {
        const ReflectedArray& array = field.arrays[k];
        if (rest.byte < array.first || array.stride == 0) return std::nullopt;
        rest.byte -= array.first;
        rest.elements[k] = rest.byte / array.stride;
        if (array.count != 0 && rest.elements[k] >= array.count) return std::nullopt;
        rest.byte %= array.stride;
    }
    return rest;
}

std::string withIndices(const std::string& path, const std::vector<uint64_t>& elements) {
    std::string text;
    size_t next = elements.size();
    for (size_t k = 0; k < path.size(); ++k) {
        text += path[k];
        if (path[k] == '[' && next > 0) text += std::to_string(elements[--next]);
    }
    return text;
}

std::optional<NumberPlace> numberIn(const ReflectedField& field, uint64_t byte) {
    const auto rest = withoutArrays(field, byte);
    if (!rest || field.scalar.empty() || rest->byte < field.offset) return std::nullopt;
    const uint32_t size = scalarBytes(field.scalar), column_bytes = field.columns > 1 ? field.matrix_stride : field.rows * size;
    const uint64_t within = rest->byte - field.offset;
    const uint64_t column = column_bytes == 0 ? 0 : within / column_bytes, row = within % std::max(column_bytes, 1u) / size;
    if (column >= field.columns || row >= field.rows) return std::nullopt;
    NumberPlace place = {withIndices(field.path, rest->elements), field.scalar, byte - within % size, size};
    if (field.columns > 1) place.path += "[" + std::to_string(column) + "]";
    if (field.rows > 1) place.path += std::string(".") + "xyzw"[row % 4];
    return place;
}

template <class Number>
std::string textOf(std::span<const std::byte> bytes) {
    Number number = {};
    std::memcpy(&number, bytes.data(), std::min(sizeof number, bytes.size()));
    char text[64];
    const auto [end, error] = std::to_chars(text, text + sizeof text, number);
    return error == std::errc() ? std::string(text, end) : "?";
}

std::string hexText(std::span<const std::byte> bytes) {
    std::string text = "0x";
    for (size_t k = bytes.size(); k-- > 0;) {
        char digits[3];
        std::snprintf(digits, sizeof digits, "%02x", static_cast<unsigned>(bytes[k]));
        text += digits;
    }
    return text;
}

} // namespace

std::optional<NumberPlace> numberAt(std::span<const ReflectedField> fields, uint64_t byte) {
    for (const ReflectedField& field : fields)
        if (auto place = numberIn(field, byte)) return place;
    return std::nullopt;
}

uint32_t elementBytes(std::span<const ReflectedField> fields) {
    constexpr uint32_t kWord = 4;
    if (fields.empty() || fields[0].arrays.empty()) return kWord;
    const ReflectedArray& outer = fields[0].arrays.back();
    const bool is_list = std::ranges::all_of(fields, [&](const ReflectedField& field) {
        return !field.arrays.empty() && field.arrays.back().first == 0 && field.arrays.back().count == 0 &&
               field.arrays.back().stride == outer.stride;
    });
    return is_list && outer.stride % kWord == 0 && outer.stride != 0 ? outer.stride : kWord;
}

std::string valueText(const std::string& scalar, std::span<const std::byte> bytes) {
    if (scalar == "float") return textOf<float>(bytes);
    if (scalar == "double") return textOf<double>(bytes);
    if (scalar == "int") return textOf<int32_t>(bytes);
    if (scalar == "uint") return textOf<uint32_t>(bytes);
    if (scalar == "int64") return textOf<int64_t>(bytes);
    if (scalar == "uint64") return textOf<uint64_t>(bytes);
    return hexText(bytes);
}

} // namespace engine
