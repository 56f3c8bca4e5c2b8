// The knobs of a step, and what turning each costs besides time, in plain words.
#pragma once

#include "modules/brittle/dynamics/step_settings.h"

#include <cstdint>
#include <span>

namespace accuracy {

// Which workloads a setting says anything about.
enum ScenesFor : uint32_t {
    kPile = 1,    // many bodies, many contacts
    kStack = 2,   // what should stand
    kSpin = 4,    // nothing touches
    kBounce = 8,  // a single blow
    kShot = 16,   // what is fast
    kWindow = 32, // what breaks
    kAllScenes = 63,
    kContactScenes = kPile | kStack | kBounce,
};

struct DynamicsSetting {
    const char* knob; // "default" of the first
    const char* setting;
    const char* loses;
    uint32_t scenes; // ScenesFor
    void (*apply)(brittle::StepSettings& settings);
};

std::span<const DynamicsSetting> dynamicsSettings();

} // namespace accuracy
