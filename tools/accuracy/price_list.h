// The price list of a device, as `brittle accuracy` has measured it last, and the setting that it says is the one for a budget
// of time or of error.
#pragma once

#include "engine/device.h"
#include "tools/accuracy/results.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace accuracy {

// In $XDG_CACHE_HOME or ~/.cache, in brittle/, by the names of device and driver. Empty where neither variable is set.
std::filesystem::path priceListPath(const std::string& device, const std::string& driver);
// Keeps what was measured; where there is no such place, or it cannot be written, nothing is kept.
void keepPriceList(const Results& results);
// Errors: BadInput, where nothing was measured yet on this device and driver, with what to do.
engine::Result<Results> readPriceList(const engine::Device& device);

// What a setting costs and what it errs, over all workloads of its family on which it was measured, the worst of each.
struct Price {
    std::string knob, setting, loses; // the default's knob is "default"
    double times = 1;                 // of the default's time
    double error = 0;                 // of the family's errors: told below, at least what the reference resolves
};

// Families that settings are picked from, with the errors that count there: fracture, by corners off and cut faces turned over,
// as shares; dynamics, by overlap in a pile, in mm. Settings that had no result somewhere, that were not measured by these
// errors, or that are effects of a scene's own are left out. The default comes first.
struct PickedFamily {
    const char* name;
    const char* error; // what it is, with its unit
};
extern const PickedFamily kFractureFamily, kDynamicsFamily;
std::vector<Price> pricesOf(const Results& results, const PickedFamily& family);

struct Wish {
    std::optional<double> budget_ms, tolerance; // of the family's error
    bool isThere() const { return budget_ms || tolerance; }
};

struct Choice {
    Price price;
    double usual_ms = 0, expected_ms = 0; // by default, as measured just now, and by the choice
    bool keeps_budget = true;
    std::string why;
};

// Of those within the tolerance the most accurate that keeps to the budget, the faster of two that are alike; without a budget
// the fastest. Where none keeps to it, the fastest. Errors: BadInput, where nothing is within the tolerance, with the least
// there is.
engine::Result<Choice> choose(const std::vector<Price>& prices, const PickedFamily& family, double usual_ms, const Wish& wish);

// A line for people: what was picked, what is expected of it, why, what one loses.
std::string choiceText(const Choice& choice, const PickedFamily& family, const Machine& measured_on);

} // namespace accuracy
