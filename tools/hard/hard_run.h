// Runs the hard cases (tests/hard), breaks at every precision, all else as it is, and scenes of motion by Bullet as well.
#pragma once

#include "engine/device.h"
#include "tools/accuracy/results.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hard {

struct RunOptions {
    std::string only; // cases whose name has this in it; empty: all
    bool is_long = false;
    bool with_bullet = false;
    std::optional<double> scale; // runs only cases of motion, at this multiple of their size
};
constexpr double kSmallestScale = 1e-3, kLargestScale = 1e3;

constexpr const char* kBulletSetting = "Bullet"; // begins the setting of rows that judge Bullet, which promise nothing

struct RunStep {
    size_t number = 0, count = 0; // the first is 0
    std::string name, setting;
};

// Told before a case begins, and of what came of it.
struct RunWatch {
    std::function<void(const RunStep&)> begins;
    std::function<void(const accuracy::HardCase&)> ended;
    std::function<void(const accuracy::HardCase&)> left_out; // its `why` is the reason; there is no outcome
};

// With Bullet, a case of motion is run by Brittle and then by Bullet, in the same steps, and judged by the same checks.
// With a scale, cases that do not judge motion alone are left out. Errors: BadInput, where no case has such a name; Feature,
// where Bullet is not in the build; Device, where fracture cannot be made. A case that fails is a case that says why.
engine::Result<std::vector<accuracy::HardCase>> runHardCases(engine::Device& device, const RunOptions& options,
                                                             const RunWatch& watch);

// Returns the names that have `only` in them, in order; those of cases that --long adds say so. Errors: BadInput, where no case
// has such a name.
engine::Result<std::vector<std::string>> hardCaseNames(const std::string& only);

} // namespace hard
