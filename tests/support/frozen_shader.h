// What is left of a kernel once its constants are set: which bindings it still reads and writes. By SPIRV-Tools, as a driver
// does it.
#pragma once

#include "engine/kernel.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace support {

class FrozenShader {
public:
    // Constants that the kernel does not declare are passed over. Fails the test where the kernel is not there or is not sound.
    FrozenShader(std::string_view kernel, std::span<const engine::SpecConstant> constants);

    // Through the binding of that name, by OpStore or an atomic; where a member is named, as "Struct.member", only to that of
    // its elements, of a vector to the first part. An element that is copied as a whole is no store to a member.
    bool stores(std::string_view binding, std::string_view member = {}) const;
    bool loads(std::string_view binding) const;
    size_t instructions() const { return instructions_; }

private:
    using Path = std::vector<uint32_t>; // into the binding; kUnknown where an index is no constant
    struct Access {
        uint32_t binding = 0;
        Path path;
        bool writes = false;
    };
    void read(std::span<const uint32_t> words);
    uint32_t bindingNamed(std::string_view name) const;
    uint32_t memberNamed(std::string_view name) const; // "Struct.member"

    engine::Reflection reflection_;
    std::vector<Access> accesses_;
    size_t instructions_ = 0;
};

} // namespace support
