// A module that is no more than the contract asks for: a kernel of its own that counts frames, and a way to ask for the count.
#pragma once

#include "engine/module.h"

#include <array>

namespace tick {

// Offered as a service under this name.
constexpr const char* kClock = "tick.clock/1";
class Clock {
public:
    virtual ~Clock() = default;
    virtual engine::Result<std::array<uint32_t, 2>> read() = 0; // frames, milliseconds
};

std::unique_ptr<engine::Module> makeTick();

} // namespace tick
