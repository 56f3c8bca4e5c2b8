#include "tools/accuracy/progress_estimate.h"

#include "tools/brittle/progress.h"

#include <cmath>
#include <cstdio>

namespace accuracy {
namespace {

constexpr double kTooEarly = 0.02; // of the whole: before, nobody knows
constexpr double kSure = 0.1;      // likewise, where something is to follow from it

std::string leftText(double seconds) {
    char text[64];
    if (seconds < 60)
        std::snprintf(text, sizeof text, "about %.0f s left", std::ceil(seconds / 5) * 5);
    else
        std::snprintf(text, sizeof text, "about %.0f min left", std::ceil(seconds / 60));
    return text;
}

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

void ProgressEstimate::begin(const std::string& part, double share) {
    if (before_ + share_ == 0) first_share_ = std::chrono::steady_clock::now();
    before_ += share_;
    share_ = share;
    part_ = part;
    show("", 0);
}

void ProgressEstimate::show(const std::string& what, double done) {
    all_ = before_ + done * share_;
    char percent[16];
    std::snprintf(percent, sizeof percent, "%.0f %%", 100 * all_);
    std::string line = std::string(percent) + ", " + part_ + (what.empty() ? "" : ": " + what);
    if (all_ > kTooEarly) line += ", " + leftText(secondsLeft());
    cli::showProgress(line);
}

double ProgressEstimate::seconds() const { return secondsSince(start_); }

double ProgressEstimate::secondsLeft() const { return secondsSince(first_share_) * (1 - all_) / all_; }

double ProgressEstimate::expectedSeconds() const { return all_ > kSure ? seconds() + secondsLeft() : 0; }

} // namespace accuracy
