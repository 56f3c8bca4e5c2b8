#include "tools/brittle/command.h"

#include "tools/brittle/progress.h"

#include <algorithm>
#include <cstdio>

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

int fail(const engine::Error& error) {
    std::string line = error.message;
    std::replace(line.begin(), line.end(), '\n', ' ');
    clearProgress();
    std::fprintf(stderr, "brittle: %s\n", line.c_str());
    return exitCode(error.code);
}

} // namespace cli
