// How far the sweep is, and how long it will still take, on a terminal.
#pragma once

#include <chrono>
#include <string>

namespace accuracy {

class ProgressEstimate {
public:
    // The next part of the work, which has so much of the whole; all parts together have 1. How long one without a share takes
    // tells nothing about the others.
    void begin(const std::string& part, double share);
    // `done`: of this part, 0 to 1.
    void show(const std::string& what, double done);
    double seconds() const; // so far
    // That all of it will take, as far as can be told; 0: too early to tell.
    double expectedSeconds() const;

private:
    double secondsLeft() const;

    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point first_share_ = start_; // when the first part that has one began
    std::string part_;
    double before_ = 0, share_ = 0; // of the whole
    double all_ = 0;                // how much of it is done
};

} // namespace accuracy
