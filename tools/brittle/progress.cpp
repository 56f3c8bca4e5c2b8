#include "tools/brittle/progress.h"

#include <chrono>
#include <cstdio>
#include <unistd.h>

namespace cli {
namespace {

constexpr const char* kEraseLine = "\r\033[K";

bool isTerminal() {
    static const bool is_terminal = isatty(STDERR_FILENO) != 0;
    return is_terminal;
}

// Nothing in the first ten seconds.
void logNowAndThen(const std::string& what) {
    using Clock = std::chrono::steady_clock;
    static Clock::time_point last = Clock::now();
    if (Clock::now() - last < std::chrono::seconds(10)) return;
    last = Clock::now();
    std::fprintf(stderr, "%s ...\n", what.c_str());
}

} // namespace

void showProgress(const std::string& what) {
    if (!isTerminal()) return logNowAndThen(what);
    std::fprintf(stderr, "%s%s ...", kEraseLine, what.c_str());
    std::fflush(stderr);
}

void clearProgress() {
    if (isTerminal()) std::fputs(kEraseLine, stderr);
}

} // namespace cli
