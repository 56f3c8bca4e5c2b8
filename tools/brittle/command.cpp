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
    case engine::ErrorCode::Device: return kDeviceError;
    case engine::ErrorCode::Internal: return kInternalError;
    }
    return kInternalError;
}

} // namespace

std::string groupSize(const std::string& text) {
    uint32_t lanes = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), lanes);
    const bool is_number = error == std::errc() && end == text.data() + text.size();
    if (is_number && std::has_single_bit(lanes) && lanes >= 8 && lanes <= 256) return "";
    return "\"" + text + "\" is no power of two from 8 to 256";
}

std::string someText(const std::string& text) { return text.empty() ? "an empty name; leave the option out instead" : ""; }

std::string notANumber(const std::string& text) { return std::isnan(std::strtod(text.c_str(), nullptr)) ? "not a number" : ""; }

int fail(const engine::Error& error) {
    std::string line = error.message;
    std::replace(line.begin(), line.end(), '\n', ' ');
    clearProgress();
    std::fprintf(stderr, "brittle: %s\n", line.c_str());
    return exitCode(error.code);
}

} // namespace cli
