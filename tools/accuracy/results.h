// What `brittle accuracy` has measured: the one source of its page, its table and whatever picks settings by what they cost.
//
// Everything that is shown is in here, words and limits included; the page only lays it out. Times are milliseconds.
#pragma once

#include "engine/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace accuracy {

constexpr const char* kFormat = "brittle accuracy";
constexpr int kVersion = 2;

// Of one thing measured again and again.
struct Samples {
    std::vector<double> raw; // in the order in which they were taken
    double median = 0;
    double low = 0, high = 0; // the quartiles
};
Samples samplesOf(std::vector<double> raw);

struct Machine {
    std::string processor, system, device, driver, compiler, brittle, commit, date; // the latter in UTC
    uint32_t cores = 0;
    double memory_gib = 0;
    double load_before = 0;                    // of the last minute, by all programs, when it began
    double seconds = 0, processor_seconds = 0; // that all of it took, this program's share of the processors
    bool is_quick = false;
    uint32_t rounds = 0, scene_rounds = 0; // of fracture and of scenes, where there were fewest
};

struct ErrorKind {
    std::string name, label, unit; // label without the unit, which is empty for shares
    std::string reference;         // what it is measured against
};

// Values at or below `resolution` are not told apart from none.
struct MeasuredError {
    std::string kind;
    double value = 0, resolution = 0;
};

struct Workload {
    std::string name, family, what;
    std::string time_of; // what the milliseconds are of
    std::string bytes_of;
    std::vector<std::string> kinds; // of its errors; by the first its settings are compared
};

// A setting of a knob, or of two, on a workload.
struct Measurement {
    std::string workload, knob, setting; // the default's knob is "default"
    std::string loses;                   // against the default, in plain words
    Samples ms;
    double bytes = 0;
    std::vector<MeasuredError> errors;
    std::string failed;       // why there is no result; then there are no errors
    double times_default = 0; // its milliseconds over the default's
    bool is_default = false;
    bool is_dominated = false; // another one is no slower and no worse, and better in one of the two
};

struct FigurePoint {
    double sites = 0;
    Samples ms;
};
struct FigureSeries {
    std::string label;
    std::vector<FigurePoint> points;
    std::string ended; // why it goes no further; empty where it goes to the end
};
struct Figure {
    std::string name, title, caption;
    bool is_logarithmic = false;
    std::vector<FigureSeries> series;
};

// Motion against time or a setting, once for each series.
struct CurvePoint {
    double x = 0, y = 0;
};
struct CurveSeries {
    std::string label;
    std::vector<CurvePoint> points;
};
struct Curve {
    std::string name, title, caption, x_label, y_label;
    bool is_logarithmic_x = false, is_logarithmic_y = false; // then all coordinates are above 0
    std::vector<CurveSeries> series;
};

struct StageTime {
    std::string stage;
    double ms = 0; // median
};
struct Shares {
    double sites = 0;
    std::vector<StageTime> stages;
};

struct PicturePair {
    std::string title, cheap_setting, dear_setting, caption;
    double cheap_ms = 0, dear_ms = 0;
    double differing_share = 0;      // of all pixels
    std::string cheap, dear, marked; // PNG files, as data URIs
};

// A density that was drawn from, or should have come out, next to what did.
struct LawBin {
    double from = 0, to = 0, measured = 0, law = 0; // densities
};
struct Law {
    std::string title, quantity, law, source;
    double count = 0;      // of what was counted
    double distance = 0;   // between the two distribution functions, at most (Kolmogorov and Smirnov)
    double resolution = 0; // what so many can tell from none, in 95 of 100 cases
    std::vector<LawBin> bins;
};

// Of a case that is hard on purpose; in the order in which they are to be shown.
struct HardCase {
    std::string name, setting;
    std::string why; // it could not be run to its end
    // Of all that was measured, what comes closest to what is allowed, or is furthest beyond it.
    std::string worst_kind, unit;
    double worst_error = 0, allowed = 0;
    bool has_passed = false, is_known_shortfall = false; // out of reach, which is known and no failure
    double ms = 0, exact_tests = 0;
};

// The same work by a library that is not ours, on one thread.
struct Peer {
    std::string name, workload;
    Samples ms;
    std::vector<MeasuredError> errors;
};

// A line of the price list that is worth more than the others.
struct UsefulLine {
    std::string text;
    size_t measurement = 0; // index
};

// How long a part of the sweep took.
struct PartTime {
    std::string part;
    double seconds = 0;
};

struct Results {
    Machine machine;
    std::vector<PartTime> parts;
    std::vector<ErrorKind> kinds;
    std::vector<Workload> workloads;
    std::vector<Measurement> measurements; // the default of a workload before all else of it
    std::vector<Peer> peers;
    std::vector<Figure> figures;
    std::vector<Curve> curves;
    std::vector<Shares> shares;
    std::vector<PicturePair> pictures;
    std::vector<Law> laws;
    std::vector<UsefulLine> useful;
    std::vector<HardCase> hard; // none where `brittle hard` was not run
};

const Workload* workloadOf(const Results& results, const std::string& name);
const ErrorKind* kindOf(const Results& results, const std::string& name);
// That the setting is compared by; nullptr where it has none.
const MeasuredError* comparedBy(const Results& results, const Measurement& measurement);

void addKind(Results& results, const ErrorKind& kind); // once

// Three digits that count, for lines of text.
std::string shortNumber(double value);

std::string encodeResults(const Results& results);
std::string encodeCsv(const Results& results); // a row a measurement and kind of error
// What follows from the times in it, from medians to useful lines, is found anew. Errors: BadInput, beginning with the file's
// name, for what cannot be read, is no such file, is not whole or no sweep leaves (results_check.h), with where.
engine::Result<Results> readResults(const std::filesystem::path& path);

} // namespace accuracy
