// What brittle compare prints.
#pragma once

#include "modules/brittle/comparison/world_comparison.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace compare {

struct ComparedDevice {
    std::string name, driver;
};

struct CompareReport {
    std::string scene;
    ComparedDevice a, b;
    double dt = 0;                   // seconds per step
    std::vector<std::string> bodies; // names, by index
    brittle::WorldComparison found;

    bool agrees() const { return !found.first_difference && (!found.traced || found.traced->comparison.finding() == nullptr); }
};

nlohmann::ordered_json compareJson(const CompareReport& report);
void printCompare(const CompareReport& report);

} // namespace compare
