// What broke in a scene, and what could not, for people and for programs.
#pragma once

#include "modules/brittle/breaking/room_to_break.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace cli {

// Of all steps, in order; `lost`: more than the device keeps between two steps.
struct BreakReport {
    double dt = 0;
    std::vector<std::string> names; // of bodies, as the scene has them; what has none goes by its number
    std::vector<gpu::BreakEvent> events;
    uint32_t lost = 0;
};

nlohmann::ordered_json breaksJson(const BreakReport& report);
// A line each, the first few of many.
void printBreaks(const BreakReport& report);

} // namespace cli
