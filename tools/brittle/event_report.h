// What broke in a scene, what could not, and what was hit, for people and for programs.
#pragma once

#include "modules/brittle/dynamics/world.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace cli {

// Of all steps, in order.
struct EventReport {
    double dt = 0;
    std::vector<std::string> names, materials; // of bodies as the world began, by their index
    brittle::Breaks breaks;
    brittle::Impacts impacts;
};

// Fragments go by the names that they have in an animation (body_cast.h).
nlohmann::ordered_json breaksJson(const EventReport& report);
// Fragments that left the world.
nlohmann::ordered_json goneJson(const EventReport& report);
nlohmann::ordered_json impactsJson(const EventReport& report);
// A line for each break, the first few of many, and one for all impacts.
void printEvents(const EventReport& report);

} // namespace cli
