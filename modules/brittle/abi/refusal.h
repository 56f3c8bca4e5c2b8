// What a call is refused with: thrown anywhere below the boundary, caught at it (boundary.h).
#pragma once

#include "engine/result.h"
#include "modules/brittle/brittle.h"

#include <string>
#include <utility>

namespace brittle::abi {

struct Refusal {
    Refusal(BrittleResult code_, std::string message_) : code(code_), message(std::move(message_)) {}
    BrittleResult code;
    std::string message;
};

inline BrittleResult codeOf(engine::ErrorCode code, BrittleResult bad_input) {
    switch (code) {
    case engine::ErrorCode::BadInput: return bad_input;
    case engine::ErrorCode::Capacity: return BRITTLE_CAPACITY;
    case engine::ErrorCode::Device: return BRITTLE_DEVICE_FAILED;
    case engine::ErrorCode::Feature: return BRITTLE_MISSING_FEATURE;
    case engine::ErrorCode::Internal: break;
    }
    return BRITTLE_INTERNAL;
}

// `bad_input`: what a fault of the host's is called here.
template <class T>
T orRefuse(engine::Result<T> result, BrittleResult bad_input = BRITTLE_BAD_VALUE) {
    if (!result) throw Refusal(codeOf(result.error().code, bad_input), result.error().message);
    if constexpr (!std::is_void_v<T>) return std::move(*result);
}

template <class T>
T& needed(T* pointer, const char* name) {
    if (pointer == nullptr) throw Refusal(BRITTLE_NULL_ARGUMENT, std::string("'") + name + "' must not be NULL");
    return *pointer;
}

// The struct that a pointer is to, once its size says that host and library mean the same by it.
template <class T>
T& sized(T* pointer, const char* name) {
    T& value = needed(pointer, name);
    if (value.struct_size != sizeof(T))
        throw Refusal(BRITTLE_WRONG_VERSION, std::string("'") + name + "' has struct_size " +
                                                 std::to_string(value.struct_size) + ", this library's is " +
                                                 std::to_string(sizeof(T)) +
                                                 "; begin with its default definition, of the header of this version");
    return value;
}

} // namespace brittle::abi
