// The plan of a scene's step, for people and for programs.
#pragma once

#include "modules/brittle/dynamics/step_plan.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace cli {

struct PlannedEffect {
    std::string name, called_by; // "" where the scene lists it
};

struct PlanReport {
    std::string scene, device;
    std::vector<PlannedEffect> effects;
    brittle::StepPlan plan;
    bool is_measured = false;
    std::vector<double> us; // of each dispatch; empty where the queue has no clock
};

nlohmann::ordered_json planJson(const PlanReport& report);
void printPlan(const PlanReport& report);

} // namespace cli
