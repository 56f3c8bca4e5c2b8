// Runs the hard cases (tests/hard), breaks at every precision, all else as it is.
#pragma once

#include "engine/device.h"
#include "tools/accuracy/results.h"

#include <functional>
#include <string>
#include <vector>

namespace hard {

struct RunOptions {
    std::string only; // cases whose name has this in it; empty: all
    bool is_long = false;
};

struct RunStep {
    size_t number = 0, count = 0; // the first is 0
    std::string name, setting;
};

// Told before a case begins, and of what came of it.
struct RunWatch {
    std::function<void(const RunStep&)> begins;
    std::function<void(const accuracy::HardCase&)> ended;
};

// Errors: BadInput, where no case has such a name; Device, where fracture cannot be made. A case that fails is a case that says
// why.
engine::Result<std::vector<accuracy::HardCase>> runHardCases(engine::Device& device, const RunOptions& options,
                                                             const RunWatch& watch);

// Of all cases, in order; those that --long adds say so.
std::vector<std::string> hardCaseNames();

} // namespace hard
