// What the subcommands have in common. Each adds itself to the app and leaves its exit code where main returns it.
#pragma once

#include "engine/result.h"

#include <CLI/CLI.hpp>

#include <string>

namespace cli {

enum ExitCode { kOk = 0, kInternalError = 1, kBadInput = 2, kCapacity = 3, kDeviceError = 4 };

using AddCommand = void (*)(CLI::App& app, int& exit_code);
void addShatter(CLI::App& app, int& exit_code);
void addDevices(CLI::App& app, int& exit_code);
void addDoctor(CLI::App& app, int& exit_code);
void addScenes(CLI::App& app, int& exit_code);
void addSimulate(CLI::App& app, int& exit_code);
void addBench(CLI::App& app, int& exit_code); // in tools/bench

// A check of the option that sets the lanes of a workgroup: empty if it is right, else what is wrong. Whether the device takes
// as many is its own question.
std::string groupSize(const std::string& text);

// Checks: of a name that may not be empty, and of what ranges let pass.
std::string someText(const std::string& text);
std::string notANumber(const std::string& text);

// Prints "brittle: MESSAGE" as one line on stderr.
int fail(const engine::Error& error);

} // namespace cli
