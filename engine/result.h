// Result<T>: a value or an Error. Shaped after std::expected, which g++ 12 has not in C++20, so that it can be replaced by it.
#pragma once

#include "engine/check.h"

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace engine {

enum class ErrorCode {
    BadInput, // a file, an option or a name that cannot be used as given
    Capacity, // a pool or buffer that is too small; the message names it and by how much
    Device,   // no usable device, or one that failed
    Feature,  // something that a device lacks or was made without; the message names it
    Internal, // a bug of ours
};

struct Error {
    ErrorCode code = ErrorCode::Internal;
    std::string message; // says what to do about it
};

template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    bool has_value() const { return state_.index() == 0; }
    explicit operator bool() const { return has_value(); }

    T& value() & {
        ENGINE_ASSERT(has_value());
        return *std::get_if<0>(&state_);
    }
    const T& value() const& {
        ENGINE_ASSERT(has_value());
        return *std::get_if<0>(&state_);
    }
    T&& value() && {
        ENGINE_ASSERT(has_value());
        return std::move(*std::get_if<0>(&state_));
    }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

    const Error& error() const {
        ENGINE_ASSERT(!has_value());
        return *std::get_if<1>(&state_);
    }

private:
    std::variant<T, Error> state_;
};

template <>
class [[nodiscard]] Result<void> {
public:
    Result() = default;
    Result(Error error) : error_(std::move(error)) {}

    bool has_value() const { return !error_.has_value(); }
    explicit operator bool() const { return has_value(); }
    const Error& error() const {
        ENGINE_ASSERT(error_.has_value());
        return *error_;
    }

private:
    std::optional<Error> error_;
};

} // namespace engine
