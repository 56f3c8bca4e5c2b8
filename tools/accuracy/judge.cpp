#include "tools/accuracy/judge.h"

#include <algorithm>
#include <optional>

namespace accuracy {
namespace {

constexpr size_t kLines = 3;
constexpr double kWorth = 0.9;        // of the default's time: what saves less is not worth a line
constexpr double kMoreAccurate = 0.7; // of the default's error, likewise

// What is below the resolution is as good as none.
double told(const MeasuredError& error) { return error.value <= error.resolution ? 0 : error.value; }

const Measurement& defaultOf(const Results& results, const Measurement& m) {
    return *std::ranges::find_if(results.measurements,
                                 [&](const Measurement& other) { return other.workload == m.workload && other.is_default; });
}

// Noise does not make one dominate another: their quartiles have to lie apart where their errors are the same.
bool dominates(const Results& results, const Measurement& a, const Measurement& b) {
    const MeasuredError *of_a = comparedBy(results, a), *of_b = comparedBy(results, b);
    if (of_a == nullptr || of_b == nullptr || !a.failed.empty() || !b.failed.empty()) return false;
    if (told(*of_a) < told(*of_b)) return a.ms.median <= b.ms.median;
    return told(*of_a) == told(*of_b) && a.ms.high < b.ms.low;
}

std::string errorText(const Results& results, const MeasuredError& error) {
    const ErrorKind& kind = *kindOf(results, error.kind);
    const bool is_none = told(error) == 0;
    return (is_none ? "below " : "") + shortNumber(is_none ? error.resolution : error.value) + " " + kind.unit;
}

std::string lineText(const Results& results, const Measurement& m) {
    const MeasuredError &error = *comparedBy(results, m), &usual = *comparedBy(results, defaultOf(results, m));
    return m.knob + " " + m.setting + " on " + m.workload + ": " + shortNumber(m.times_default) +
           " times the default's time; " + kindOf(results, error.kind)->label + " " + errorText(results, error) +
           " instead of " + errorText(results, usual);
}

// Few runs of a busy machine are told apart only where every one of the one was faster than every one of the other.
bool isAlwaysFaster(const Measurement& a, const Measurement& b) {
    return std::ranges::max(a.ms.raw) < std::ranges::min(b.ms.raw);
}

// What a setting has for what it costs, next to the default's.
struct Trade {
    double ms, usual_ms, error, usual_error;
    double times() const { return ms / usual_ms; }
};

// How much a line about it is worth; only the most valuable of each is told.
using Worth = std::optional<double> (*)(const Trade& trade);

// Milliseconds.
std::optional<double> savesForNothing(const Trade& t) {
    return t.times() < kWorth && t.error <= t.usual_error ? std::optional(t.usual_ms - t.ms) : std::nullopt;
}
// Times faster for times worse.
std::optional<double> savesForSomething(const Trade& t) {
    return t.times() < kWorth && t.error > t.usual_error ? std::optional(t.usual_error / t.error / t.times()) : std::nullopt;
}
// Times better for times slower.
std::optional<double> buysAccuracy(const Trade& t) {
    return t.error < kMoreAccurate * t.usual_error ? std::optional(t.usual_error / t.error / t.times()) : std::nullopt;
}

Trade tradeOf(const Measurement& m, const MeasuredError& error, const Measurement& usual, const MeasuredError& usual_error) {
    const bool differ = isAlwaysFaster(m, usual) || isAlwaysFaster(usual, m);
    return {differ ? m.ms.median : usual.ms.median, usual.ms.median, std::max(error.value, error.resolution),
            std::max(usual_error.value, usual_error.resolution)};
}

bool isTold(const Results& results, const Measurement& m) {
    return std::ranges::any_of(results.useful, [&](const UsefulLine& line) {
        const Measurement& other = results.measurements[line.measurement];
        return other.knob == m.knob && other.setting == m.setting;
    });
}

// Lines are told of the workload that a family begins with, which is the one that stands for it.
bool standsForFamily(const Results& results, const Measurement& m) {
    const Workload& own = *workloadOf(results, m.workload);
    return &own == &*std::ranges::find(results.workloads, own.family, &Workload::family);
}

void addLine(Results& results, Worth worth) {
    std::optional<double> best;
    size_t index = 0;
    for (size_t k = 0; k < results.measurements.size(); ++k) {
        const Measurement& m = results.measurements[k];
        const MeasuredError* error = comparedBy(results, m);
        const MeasuredError* usual = comparedBy(results, defaultOf(results, m));
        if (!standsForFamily(results, m) || isTold(results, m) || m.is_default || m.is_dominated || error == nullptr ||
            usual == nullptr || !m.failed.empty())
            continue;
        const auto value = worth(tradeOf(m, *error, defaultOf(results, m), *usual));
        if (!value || (best && *value <= *best)) continue;
        best = value;
        index = k;
    }
    if (best) results.useful.push_back({lineText(results, results.measurements[index]), index});
}

} // namespace

void judge(Results& results) {
    for (Measurement& m : results.measurements) {
        const double usual = defaultOf(results, m).ms.median;
        m.times_default = usual > 0 ? m.ms.median / usual : 0;
        m.is_dominated = std::ranges::any_of(results.measurements, [&](const Measurement& other) {
            return other.workload == m.workload && dominates(results, other, m);
        });
    }
    results.useful.clear();
    addLine(results, savesForNothing);
    addLine(results, savesForSomething);
    addLine(results, buysAccuracy);
    // Where one of them has nothing to tell, the next best of the others.
    if (results.useful.size() < kLines) addLine(results, savesForSomething);
    if (results.useful.size() < kLines) addLine(results, buysAccuracy);
}

} // namespace accuracy
