#include "tools/accuracy/fracture_run.h"

#include "tools/brittle/model.h"

#include <algorithm>
#include <cstring>
#include <optional>

namespace accuracy {
namespace {

using brittle::FractureOptions;
using brittle::FractureResult;
using engine::Result;

constexpr uint32_t kFewestBreaks = 3; // that have a median and quartiles

template <class T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool sameFragments(const FractureResult& a, const FractureResult& b) {
    return sameBytes(a.fragments.vertices, b.fragments.vertices) && sameBytes(a.fragments.indices, b.fragments.indices);
}

// One setting of the case, with a fracturer of its own, so that its memory can be told.
struct FractureCandidate {
    const FractureSetting* setting;
    FractureOptions options;
    std::unique_ptr<brittle::Fracture> fracture;
    Measurement measurement;
    std::vector<double> ms;
};

class CaseRun {
public:
    CaseRun(Sweep& sweep, const FractureCase& what, const FractureMeasures& measures)
        : sweep_(sweep), case_(what), measures_(measures) {}

    Result<void> run() {
        for (const FractureSetting& setting : case_.settings)
            if (auto added = addCandidate(setting); !added) return added;
        uint32_t round = 0;
        for (; round < sweep_.options.rounds() && !(round >= kFewestBreaks && sweep_.isLate()); ++round)
            if (auto done = runRound(round); !done) return done;
        sweep_.results.machine.rounds = std::min(sweep_.results.machine.rounds, round);
        for (FractureCandidate& candidate : candidates_) {
            candidate.measurement.ms = samplesOf(std::move(candidate.ms));
            sweep_.results.measurements.push_back(std::move(candidate.measurement));
        }
        return {};
    }

private:
    Result<void> runRound(uint32_t round) {
        for (size_t k = 0; k < candidates_.size(); ++k) { // another one begins each round
            FractureCandidate& candidate = candidates_[(k + round) % candidates_.size()];
            showRound(round);
            if (candidate.measurement.failed.empty())
                if (auto timed = runOnce(candidate); !timed) return timed.error();
        }
        return {};
    }

    void showRound(uint32_t round) const {
        const double done = (1.0 + round) / (1.0 + sweep_.options.rounds());
        sweep_.progress.show(case_.workload.name, case_.before + case_.share * done);
    }

    // The first run compiles and is not timed; errors are those of its result.
    Result<void> addCandidate(const FractureSetting& setting) {
        sweep_.progress.show(case_.workload.name + ", " + setting.setting, case_.before);
        FractureCandidate& candidate = candidates_.emplace_back();
        candidate.setting = &setting;
        candidate.options = case_.base;
        setting.apply(candidate.options);
        candidate.measurement.workload = case_.workload.name;
        candidate.measurement.knob = setting.knob;
        candidate.measurement.setting = setting.setting;
        candidate.measurement.loses = setting.loses;
        candidate.measurement.is_default = candidates_.size() == 1;
        const uint64_t before = sweep_.device.memory().takenBytes();
        auto fracture = brittle::Fracture::create(sweep_.device, sweep_.options.group_size);
        if (!fracture) return fracture.error();
        candidate.fracture = std::move(*fracture);
        auto result = candidate.fracture->shatter(case_.model.mesh, case_.model.topology, candidate.options);
        if (!result) return noteFailure(candidate, result.error());
        candidate.measurement.bytes = static_cast<double>(sweep_.device.memory().takenBytes() - before);
        findErrors(candidate, *result);
        if (!default_) default_ = std::move(*result);
        return {};
    }

    // Without its default a workload has nothing to compare with.
    Result<void> noteFailure(FractureCandidate& candidate, const engine::Error& error) const {
        if (candidate.measurement.is_default) return engine::Error{error.code, case_.workload.name + ": " + error.message};
        candidate.measurement.failed = error.message;
        return {};
    }

    void findErrors(FractureCandidate& candidate, const FractureResult& result) {
        if (!default_ && measures_.prepare) measures_.prepare(result);
        const bool is_same = default_ && sameFragments(*default_, result) && candidate.options.collider == case_.base.collider;
        candidate.measurement.errors =
            is_same ? candidates_.front().measurement.errors : measures_.errors(result, candidate.options);
    }

    Result<void> runOnce(FractureCandidate& candidate) const {
        const auto result = candidate.fracture->shatter(case_.model.mesh, case_.model.topology, candidate.options);
        if (!result) return noteFailure(candidate, result.error());
        candidate.ms.push_back(measures_.time(*result));
        return {};
    }

    Sweep& sweep_;
    const FractureCase& case_;
    const FractureMeasures& measures_;
    std::vector<FractureCandidate> candidates_;
    std::optional<FractureResult> default_;
};

} // namespace

Result<void> measureCase(Sweep& sweep, const FractureCase& what, const FractureMeasures& measures) {
    sweep.results.workloads.push_back(what.workload);
    return CaseRun(sweep, what, measures).run();
}

Result<brittle::PreparedMesh> soundModel(const std::string& name) {
    auto model = cli::loadModel(name, false);
    if (!model) return model.error();
    const auto checked = brittle::checkMesh(model->model.mesh, model->model.topology);
    if (!checked) return engine::Error{checked.error().code, name + ": " + checked.error().message};
    return std::move(model->model);
}

} // namespace accuracy
