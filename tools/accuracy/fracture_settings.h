// The knobs of fracture, and what turning each costs besides time, in plain words.
#pragma once

#include "modules/brittle/fracture/fracture.h"

#include <span>

namespace accuracy {

struct FractureSetting {
    const char* knob; // "default" of the first
    const char* setting;
    const char* loses;
    void (*apply)(brittle::FractureOptions& options);
};

std::span<const FractureSetting> fractureSettings();
std::span<const FractureSetting> colliderSettings();
std::span<const FractureSetting> patternSettings();
std::span<const FractureSetting> crowdingSettings();

} // namespace accuracy
