#include "tests/reference/glb_chunks.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace reference {
namespace {

using Json = nlohmann::json;

constexpr uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int kFloat = 5126;

uint32_t wordAt(const std::vector<char>& bytes, size_t offset) {
    requireGlb(offset + 4 <= bytes.size(), "ends within a header");
    uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, 4);
    return word;
}

size_t componentSize(int type) {
    switch (type) {
    case 5121: return 1;
    case 5123: return 2;
    case 5125:
    case kFloat: return 4;
    default: throw std::runtime_error("GLB: component type " + std::to_string(type) + " is not read");
    }
}

size_t componentCount(const std::string& type) {
    if (type == "SCALAR") return 1;
    requireGlb(type.size() == 4 && type.starts_with("VEC"), "accessor type " + type + " is not read");
    return static_cast<size_t>(type[3] - '0');
}

} // namespace

void requireGlb(bool condition, const std::string& what) {
    if (!condition) throw std::runtime_error("GLB: " + what);
}

GlbChunks readGlbChunks(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    requireGlb(file.good(), "cannot open " + path);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
    requireGlb(wordAt(bytes, 0) == kMagic && wordAt(bytes, 4) == 2, "not a GLB of version 2");
    requireGlb(wordAt(bytes, 8) == bytes.size(), "length in the header is not the file's");
    GlbChunks chunks;
    for (size_t at = 12; at < bytes.size();) {
        const size_t size = wordAt(bytes, at), kind = wordAt(bytes, at + 4), first = at + 8;
        requireGlb(first + size <= bytes.size(), "a chunk runs past the end");
        const char* data = bytes.data() + first;
        if (kind == kJsonChunk) chunks.json = Json::parse(data, data + size);
        if (kind == kBinaryChunk) chunks.binary.assign(data, data + size);
        at = first + size;
    }
    requireGlb(chunks.json.is_object(), "no JSON chunk");
    return chunks;
}

std::vector<double> readAccessor(const GlbChunks& glb, const Json& index) {
    const Json& accessor = glb.json.at("accessors").at(index.get<size_t>());
    const Json& view = glb.json.at("bufferViews").at(accessor.at("bufferView").get<size_t>());
    const int type = accessor.at("componentType").get<int>();
    const size_t size = componentSize(type), width = componentCount(accessor.at("type").get<std::string>());
    const size_t count = accessor.at("count").get<size_t>(), stride = view.value("byteStride", size * width);
    const size_t first = view.value("byteOffset", size_t{0}) + accessor.value("byteOffset", size_t{0});
    requireGlb(count > 0, "an empty accessor");
    requireGlb(first + (count - 1) * stride + size * width <= glb.binary.size(), "an accessor runs past the buffer");
    std::vector<double> numbers;
    numbers.reserve(count * width);
    for (size_t k = 0; k < count * width; ++k) {
        const char* from = glb.binary.data() + first + k / width * stride + k % width * size;
        float real = 0;
        uint32_t whole = 0;
        if (type == kFloat)
            std::memcpy(&real, from, size);
        else
            std::memcpy(&whole, from, size);
        numbers.push_back(type == kFloat ? static_cast<double>(real) : static_cast<double>(whole));
    }
    return numbers;
}

Point row(const std::vector<double>& numbers, size_t k) {
    requireGlb(3 * k + 2 < numbers.size(), "an index past the last vertex");
    return {numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]};
}

Point pointOf(const Json& list) {
    requireGlb(list.is_array() && list.size() == 3, "three numbers expected");
    return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

} // namespace reference
