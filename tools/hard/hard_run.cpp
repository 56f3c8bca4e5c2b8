#include "tools/hard/hard_run.h"

#include "tests/hard/hard_fractures.h"
#include "tests/hard/hard_meshes.h"
#include "tests/hard/hard_worlds.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

namespace hard {
namespace {

using accuracy::HardCase;
using brittle::Precision;

constexpr const char* kUsual = "as it is";
constexpr Precision kPrecisions[] = {Precision::Exact, Precision::Double, Precision::Fast};

struct Job {
    std::string name, setting;
    std::function<FractureCost(Trial&)> run; // a cost of nothing: by the clock
};

// How much of what is allowed is used up.
double useOf(const Check& check) {
    if (check.allowed > 0) return check.value / check.allowed;
    return check.value > check.allowed ? std::numeric_limits<double>::infinity() : 0;
}

HardCase outcomeOf(const Job& job, const Trial& trial, const FractureCost& cost) {
    HardCase outcome;
    outcome.name = job.name;
    outcome.setting = job.setting;
    outcome.has_passed = trial.holds();
    outcome.why = trial.failure().value_or("");
    outcome.ms = cost.ms;
    outcome.exact_tests = cost.exact_tests;
    const auto& checks = trial.checks();
    const auto worst = std::ranges::max_element(checks, {}, useOf);
    if (worst == checks.end()) return outcome;
    outcome.worst_kind = worst->what;
    outcome.unit = worst->unit;
    outcome.worst_error = worst->value;
    outcome.allowed = worst->allowed;
    outcome.is_known_shortfall = worst->is_known_shortfall && !worst->holds();
    return outcome;
}

// One for all, so that pipelines are made once.
void addFractures(std::vector<Job>& jobs, const std::shared_ptr<brittle::Fracture>& fracture) {
    for (const FractureCase& one : fractureCases())
        for (const Precision precision : kPrecisions)
            jobs.push_back({one.name, brittle::nameOf(precision), [one, precision, fracture](Trial& trial) {
                                return measureFracture(trial, *fracture, one, precision);
                            }});
}

// What is not broken at several precisions, and costs what the clock says.
void addJob(std::vector<Job>& jobs, const char* name, const std::function<void(Trial&)>& measure) {
    jobs.push_back({name, kUsual, [measure](Trial& trial) {
                        measure(trial);
                        return FractureCost();
                    }});
}

void addOthers(std::vector<Job>& jobs, bool is_long) {
    for (const MeshCase& one : meshCases())
        addJob(jobs, one.name, [&one](Trial& trial) { measureMesh(trial, one); });
    for (const PoolCase& one : poolCases())
        addJob(jobs, one.name, [&one](Trial& trial) { measurePool(trial, one); });
    for (const SceneCase& one : sceneCases())
        if (is_long || !one.is_long) addJob(jobs, one.name, [&one](Trial& trial) { one.measure(trial, one); });
}

HardCase runJob(engine::Device& device, const Job& job) {
    Trial trial(device);
    const auto begun = std::chrono::steady_clock::now();
    FractureCost cost = job.run(trial);
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begun;
    if (cost.ms == 0) cost.ms = taken.count();
    return outcomeOf(job, trial, cost);
}

} // namespace

engine::Result<std::vector<HardCase>> runHardCases(engine::Device& device, const RunOptions& options, const RunWatch& watch) {
    auto made = brittle::Fracture::create(device);
    if (!made) return made.error();
    std::vector<Job> jobs;
    addFractures(jobs, std::shared_ptr<brittle::Fracture>(std::move(*made)));
    addOthers(jobs, options.is_long);
    std::erase_if(jobs, [&](const Job& job) { return job.name.find(options.only) == std::string::npos; });
    if (jobs.empty())
        return engine::Error{engine::ErrorCode::BadInput,
                             "no hard case has \"" + options.only + "\" in its name; brittle hard --list names them all"};
    std::vector<HardCase> outcomes;
    for (const Job& job : jobs) {
        watch.begins({outcomes.size(), jobs.size(), job.name, job.setting});
        outcomes.push_back(runJob(device, job));
        watch.ended(outcomes.back());
    }
    return outcomes;
}

std::vector<std::string> hardCaseNames() {
    std::vector<std::string> names;
    for (const FractureCase& one : fractureCases())
        names.push_back(one.name);
    for (const MeshCase& one : meshCases())
        names.emplace_back(one.name);
    for (const PoolCase& one : poolCases())
        names.emplace_back(one.name);
    for (const SceneCase& one : sceneCases())
        names.emplace_back(one.is_long ? std::string(one.name) + " (long)" : one.name);
    return names;
}

} // namespace hard
