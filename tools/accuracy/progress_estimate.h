// How far the sweep is, and how long it will still take, on a terminal.
#pragma once

#include <chrono>
#include <string>

namespace accuracy {

class ProgressEstimate {
public:
    // The next part of the work, which has so much of the whole; all parts together have 1.
    void begin(const std::string& part, double share);
    // `done`: of this part, 0 to 1.
    void show(const std::string& what, double done);
    double seconds() const;

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::string part_;
    double before_ = 0, share_ = 0; // of the whole
};

} // namespace accuracy
