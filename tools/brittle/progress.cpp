#include "tools/brittle/progress.h"

#include <cstdio>
#include <unistd.h>

namespace cli {
namespace {

constexpr const char* kEraseLine = "\r\033[K";

bool isTerminal() {
    static const bool is_terminal = isatty(STDERR_FILENO) != 0;
    return is_terminal;
}

} // namespace

void showProgress(const std::string& what) {
    if (!isTerminal()) return;
    std::fprintf(stderr, "%s%s ...", kEraseLine, what.c_str());
    std::fflush(stderr);
}

void clearProgress() {
    if (isTerminal()) std::fputs(kEraseLine, stderr);
}

} // namespace cli
