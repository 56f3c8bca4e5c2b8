// What the subcommands have in common. Each adds itself to the app and leaves its exit code where main returns it.
#pragma once

#include "engine/result.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>

namespace cli {

enum ExitCode { kOk = 0, kInternalError = 1, kBadInput = 2, kCapacity = 3, kDeviceError = 4 };

using AddCommand = void (*)(CLI::App& app, int& exit_code);
void addShatter(CLI::App& app, int& exit_code);
void addDevices(CLI::App& app, int& exit_code);
void addDoctor(CLI::App& app, int& exit_code);
void addScenes(CLI::App& app, int& exit_code);
void addPlan(CLI::App& app, int& exit_code);
void addSimulate(CLI::App& app, int& exit_code);
void addBench(CLI::App& app, int& exit_code);       // in tools/bench
void addAccuracy(CLI::App& app, int& exit_code);    // in tools/accuracy
void addHard(CLI::App& app, int& exit_code);        // in tools/hard
void addCompare(CLI::App& app, int& exit_code);     // in tools/compare
void addCheckDevice(CLI::App& app, int& exit_code); // in tools/device_check

// A check of a name that may not be empty.
std::string someText(const std::string& text);

// A number from `low` to `high`; ranges alone let pass what is none.
CLI::Option* inRange(CLI::Option* option, double low, double high);

// --device and --group-size; `same` ends the sentence on the latter, such as "; the motion is the same".
void addGroupSizeOption(CLI::App& command, uint32_t& group_size, const std::string& same = "");
void addDeviceOptions(CLI::App& command, std::string& device, uint32_t& group_size, const std::string& same = "");

// Prints "brittle: MESSAGE" as one line on stderr.
int fail(const engine::Error& error);

// Checks that all that was printed has arrived on standard output. A command that writes files calls it before it commits them,
// so that a run that fails leaves none. Errors: BadInput, for instance for a full disk.
engine::Result<void> checkPrinted();

} // namespace cli
