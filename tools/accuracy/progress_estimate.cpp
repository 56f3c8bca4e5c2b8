#include "tools/accuracy/progress_estimate.h"

#include "tools/brittle/progress.h"

#include <cmath>
#include <cstdio>

namespace accuracy {
namespace {

constexpr double kTooEarly = 0.02; // of the whole: before, nobody knows

std::string leftText(double seconds) {
    char text[64];
    if (seconds < 60)
        std::snprintf(text, sizeof text, "about %.0f s left", std::ceil(seconds / 5) * 5);
    else
        std::snprintf(text, sizeof text, "about %.0f min left", std::ceil(seconds / 60));
    return text;
}

} // namespace

void ProgressEstimate::begin(const std::string& part, double share) {
    before_ += share_;
    share_ = share;
    part_ = part;
    show("", 0);
}

void ProgressEstimate::show(const std::string& what, double done) {
    const double all = before_ + done * share_;
    char percent[16];
    std::snprintf(percent, sizeof percent, "%.0f %%", 100 * all);
    std::string line = std::string(percent) + ", " + part_ + (what.empty() ? "" : ": " + what);
    if (all > kTooEarly) line += ", " + leftText(seconds() * (1 - all) / all);
    cli::showProgress(line);
}

double ProgressEstimate::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

} // namespace accuracy
