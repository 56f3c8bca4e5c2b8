#include "tools/accuracy/results.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace accuracy {
namespace {

double quantile(const std::vector<double>& sorted, double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<size_t>(place);
    const size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

} // namespace

Samples samplesOf(std::vector<double> raw) {
    Samples samples{std::move(raw)};
    if (samples.raw.empty()) return samples;
    std::vector<double> sorted = samples.raw;
    std::ranges::sort(sorted);
    samples.median = quantile(sorted, 0.5);
    samples.low = quantile(sorted, 0.25);
    samples.high = quantile(sorted, 0.75);
    return samples;
}

void addKind(Results& results, const ErrorKind& kind) {
    if (kindOf(results, kind.name) == nullptr) results.kinds.push_back(kind);
}

const Workload* workloadOf(const Results& results, const std::string& name) {
    for (const Workload& workload : results.workloads)
        if (workload.name == name) return &workload;
    return nullptr;
}

const ErrorKind* kindOf(const Results& results, const std::string& name) {
    for (const ErrorKind& kind : results.kinds)
        if (kind.name == name) return &kind;
    return nullptr;
}

const MeasuredError* comparedBy(const Results& results, const Measurement& measurement) {
    const Workload* workload = workloadOf(results, measurement.workload);
    if (workload == nullptr || workload->kinds.empty()) return nullptr;
    for (const MeasuredError& error : measurement.errors)
        if (error.kind == workload->kinds.front()) return &error;
    return nullptr;
}

std::string shortNumber(double value) {
    const double size = std::fabs(value);
    const bool is_plain = size >= 1e-3 && size < 1e6;
    const int decimals = is_plain ? std::max(0, 2 - static_cast<int>(std::floor(std::log10(size)))) : 0;
    char text[32];
    std::snprintf(text, sizeof text, is_plain ? "%.*f" : "%.*g", is_plain ? decimals : 2, value);
    std::string shown = text;
    if (is_plain && shown.find('.') != std::string::npos) {
        shown.erase(shown.find_last_not_of('0') + 1);
        if (shown.ends_with('.')) shown.pop_back();
    }
    return shown;
}

} // namespace accuracy
