#include "tools/accuracy/results_check.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace accuracy {
namespace {

// The first flaw that is found; places are JSON pointers.
class Check {
public:
    explicit Check(const Results& results) : results_(results) {}

    std::string run() {
        checkNames("/kinds", results_.kinds);
        checkNames("/workloads", results_.workloads);
        each("/measurements", results_.measurements,
             [&](const std::string& at, const Measurement& m) { checkMeasurement(at, m); });
        each("/workloads", results_.workloads, [&](const std::string& at, const Workload& w) { checkWorkload(at, w); });
        each("/peers", results_.peers, [&](const std::string& at, const Peer& peer) {
            expectNamed(at, "workload", peer.workload, workloadOf(results_, peer.workload));
            checkSamples(at, peer.ms);
            checkErrors(at, peer.errors);
        });
        each("/figures", results_.figures, [&](const std::string& at, const Figure& figure) { checkFigure(at, figure); });
        each("/curves", results_.curves, [&](const std::string& at, const Curve& curve) { checkCurve(at, curve); });
        each("/shares", results_.shares, [&](const std::string& at, const Shares& shares) { checkShares(at, shares); });
        each("/pictures", results_.pictures, [&](const std::string& at, const PicturePair& pair) {
            for (const std::string& picture : {pair.cheap, pair.dear, pair.marked})
                expect(picture.starts_with("data:image/png;base64,"), at, "has a picture that is no PNG");
        });
        each("/laws", results_.laws, [&](const std::string& at, const Law& law) { checkLaw(at, law); });
        each("/hard", results_.hard, [&](const std::string& at, const HardCase& one) {
            expect(!one.name.empty() && !one.setting.empty(), at, "has no name or no setting");
            expect(one.ms >= 0, at, "took less than no time");
        });
        return flaw_;
    }

private:
    void expect(bool holds, const std::string& at, const std::string& flaw) {
        if (!holds && flaw_.empty()) flaw_ = at + " " + flaw;
    }
    void expectNamed(const std::string& at, const char* what, const std::string& name, const void* found) {
        expect(found != nullptr, at, std::string("names the ") + what + " \"" + name + "\", which is not in the file");
    }
    template <class Part, class Look>
    void each(const std::string& at, const std::vector<Part>& parts, const Look& look) {
        expect(parts.size() < 1'000'000, at, "has a million parts and more");
        for (size_t k = 0; k < parts.size() && flaw_.empty(); ++k)
            look(at + "/" + std::to_string(k), parts[k]);
    }

    template <class Named>
    void checkNames(const std::string& at, const std::vector<Named>& all) {
        std::set<std::string> names;
        each(at, all, [&](const std::string& place, const Named& one) {
            expect(!one.name.empty(), place, "has no name");
            expect(names.insert(one.name).second, place, "has the name of another, \"" + one.name + "\"");
        });
    }

    // Its default stands first, had a result, and is the only one.
    void checkWorkload(const std::string& at, const Workload& workload) {
        expect(!workload.kinds.empty(), at, "has no kind of error");
        for (const std::string& kind : workload.kinds)
            expectNamed(at, "error", kind, kindOf(results_, kind));
        const Measurement* first = nullptr;
        size_t defaults = 0;
        for (const Measurement& m : results_.measurements)
            if (m.workload == workload.name) {
                if (first == nullptr) first = &m;
                if (m.is_default) ++defaults;
            }
        expect(first != nullptr, at, "was not measured");
        expect(first != nullptr && first->is_default && first->failed.empty() && defaults == 1, at,
               "has no default that had a result, more than one, or another setting before it");
    }

    void checkMeasurement(const std::string& at, const Measurement& m) {
        expectNamed(at, "workload", m.workload, workloadOf(results_, m.workload));
        expect(!m.knob.empty() && !m.setting.empty(), at, "has no knob or no setting");
        if (!m.failed.empty()) return checkErrors(at, m.errors);
        checkSamples(at, m.ms);
        expect(std::isfinite(m.bytes) && m.bytes >= 0, at, "has less than no bytes");
        expect(!m.errors.empty(), at, "has no error and has not failed");
        checkErrors(at, m.errors);
    }

    void checkSamples(const std::string& at, const Samples& ms) {
        expect(!ms.raw.empty(), at + "/ms/raw", "is empty");
        expect(std::ranges::all_of(ms.raw, [](double x) { return std::isfinite(x) && x > 0; }), at + "/ms/raw",
               "has a time that is not above 0 ms");
    }

    void checkErrors(const std::string& at, const std::vector<MeasuredError>& errors) {
        each(at + "/errors", errors, [&](const std::string& place, const MeasuredError& error) {
            expectNamed(place, "error", error.kind, kindOf(results_, error.kind));
            expect(std::isfinite(error.value) && error.value >= 0, place, "is below 0");
            expect(std::isfinite(error.resolution) && error.resolution > 0, place, "has a resolution that is not above 0");
        });
    }

    void checkFigure(const std::string& at, const Figure& figure) {
        size_t points = 0;
        each(at + "/series", figure.series, [&](const std::string& series_at, const FigureSeries& series) {
            points += series.points.size();
            each(series_at + "/points", series.points, [&](const std::string& place, const FigurePoint& point) {
                expect(std::isfinite(point.sites) && point.sites > 0, place, "has no sites");
                checkSamples(place, point.ms);
            });
        });
        expect(points > 0, at, "has no point");
    }

    void checkCurve(const std::string& at, const Curve& curve) {
        const auto fits = [](double value, bool is_logarithmic) {
            return std::isfinite(value) && (is_logarithmic ? value > 0 : value >= 0);
        };
        size_t points = 0;
        each(at + "/series", curve.series, [&](const std::string& series_at, const CurveSeries& series) {
            points += series.points.size();
            each(series_at + "/points", series.points, [&](const std::string& place, const CurvePoint& point) {
                expect(fits(point.x, curve.is_logarithmic_x) && fits(point.y, curve.is_logarithmic_y), place,
                       "has a coordinate that its axis cannot show");
            });
        });
        expect(points > 0, at, "has no point");
    }

    void checkShares(const std::string& at, const Shares& shares) {
        double whole = 0;
        each(at + "/stages", shares.stages, [&](const std::string& place, const StageTime& stage) {
            expect(std::isfinite(stage.ms) && stage.ms >= 0, place, "took less than no time");
            whole += stage.ms;
        });
        expect(std::isfinite(shares.sites) && shares.sites > 0 && whole > 0, at, "has no sites or took no time");
    }

    void checkLaw(const std::string& at, const Law& law) {
        expect(!law.bins.empty(), at + "/bins", "is empty");
        double densities = 0;
        each(at + "/bins", law.bins, [&](const std::string& place, const LawBin& bin) {
            expect(std::isfinite(bin.to) && bin.from >= 0 && bin.from < bin.to, place, "does not end after it begins");
            expect(std::isfinite(bin.measured) && std::isfinite(bin.law) && bin.measured >= 0 && bin.law >= 0, place,
                   "has a density below 0");
            densities += bin.measured + bin.law;
        });
        expect(densities > 0, at, "is 0 everywhere");
    }

    const Results& results_;
    std::string flaw_;
};

} // namespace

std::string flawOf(const Results& results) { return Check(results).run(); }

} // namespace accuracy
