// --budget-ms and --tolerance: the setting that the prices of this device call for (tools/accuracy/price_list.h).
#pragma once

#include "engine/device.h"
#include "modules/brittle/dynamics/step_settings.h"
#include "modules/brittle/fracture/fracture.h"
#include "tools/accuracy/price_list.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace cli {

// What was picked, and what came of it.
struct AutoReport {
    accuracy::Choice choice;
    std::string text;      // for people
    double taken_ms = 0;   // by what was picked, once
    std::string fell_back; // why the default was taken in the end; empty where it was not
};

// `per`: what the milliseconds are of; `error`: what the tolerance is of.
void addAutoOptions(CLI::App& command, accuracy::Wish& wish, const std::string& per, const std::string& error);

// Errors: BadInput, where there are no prices of the device, or nothing is within the tolerance.
engine::Result<AutoReport> pickSetting(const engine::Device& device, const accuracy::PickedFamily& family, double usual_ms,
                                       const accuracy::Wish& wish);
void applyTo(brittle::FractureOptions& options, const accuracy::Price& price);
void applyTo(brittle::StepSettings& settings, const accuracy::Price& price);

nlohmann::ordered_json autoJson(const AutoReport& report);
void printAuto(const AutoReport& report);

} // namespace cli
