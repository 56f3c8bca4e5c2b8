// StringNames and Strings of the engine's, for as long as a call takes.
#pragma once

#include "modules/brittle/godot/interface/host.h"

#include <string_view>

namespace brittle_godot {

class Name {
public:
    explicit Name(const char* latin1) { host().string_name_new_with_latin1_chars(bytes_, latin1, 0); }
    ~Name() { host().variant_get_ptr_destructor(static_cast<int32_t>(Type::StringName))(bytes_); }
    Name(const Name&) = delete;
    Name& operator=(const Name&) = delete;
    void* raw() { return bytes_; }

private:
    alignas(8) std::byte bytes_[kStringNameBytes];
};

class Text {
public:
    explicit Text(std::string_view utf8) {
        host().string_new_with_utf8_chars_and_len(bytes_, utf8.data(), static_cast<int64_t>(utf8.size()));
    }
    ~Text() { host().variant_get_ptr_destructor(static_cast<int32_t>(Type::String))(bytes_); }
    Text(const Text&) = delete;
    Text& operator=(const Text&) = delete;
    void* raw() { return bytes_; }

private:
    alignas(8) std::byte bytes_[kStringBytes];
};

} // namespace brittle_godot
