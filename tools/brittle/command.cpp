#include "tools/brittle/command.h"

#include "tools/brittle/progress.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace cli {
namespace {

ExitCode exitCode(engine::ErrorCode code) {
    switch (code) {
    case engine::ErrorCode::BadInput: return kBadInput;
    case engine::ErrorCode::Capacity: return kCapacity;
    case engine::ErrorCode::Device:
    case engine::ErrorCode::Feature: return kDeviceError;
    case engine::ErrorCode::Internal: return kInternalError;
    }
    return kInternalError;
}

// Empty if it is right, else what is wrong. Whether the device takes as many is its own question.
std::string groupSize(const std::string& text) {
    uint32_t lanes = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), lanes);
    const bool is_number = error == std::errc() && end == text.data() + text.size();
    if (is_number && std::has_single_bit(lanes) && lanes >= 8 && lanes <= 256) return "";
    return "\"" + text + "\" is no power of two from 8 to 256";
}

} // namespace

std::string someText(const std::string& text) { return text.empty() ? "an empty name; leave the option out instead" : ""; }

CLI::Option* inRange(CLI::Option* option, double low, double high) {
    return option->check(CLI::Range(low, high))->check([](const std::string& text) {
        return std::isnan(std::strtod(text.c_str(), nullptr)) ? "not a number" : "";
    });
}

void addGroupSizeOption(CLI::App& command, uint32_t& group_size, const std::string& same) {
    command.add_option("--group-size", group_size, "lanes of a workgroup, a power of two from 8 to 256" + same)
        ->check(groupSize)
        ->option_text("N [64]");
}

void addDeviceOptions(CLI::App& command, std::string& device, uint32_t& group_size, const std::string& same) {
    command.add_option("--device", device, "a part of its name, or its index; see brittle devices");
    addGroupSizeOption(command, group_size, same);
}

int fail(const engine::Error& error) {
    std::string line = error.message;
    std::replace(line.begin(), line.end(), '\n', ' ');
    clearProgress();
    std::fprintf(stderr, "brittle: %s\n", line.c_str());
    return exitCode(error.code);
}

// A failed write of more than a buffer leaves nothing for fflush to fail at. The stream remembers it.
engine::Result<void> checkPrinted() {
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return {};
    return engine::Error{engine::ErrorCode::BadInput, "standard output cannot be written; the disk may be full"};
}

} // namespace cli
