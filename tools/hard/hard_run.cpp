#include "tools/hard/hard_run.h"

#include "tests/hard/hard_fractures.h"
#include "tests/hard/hard_meshes.h"
#include "tests/hard/hard_worlds.h"
#include "tests/support/scaled_mover.h"
#include "tools/bench/bullet_mover.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <memory>

namespace hard {
namespace {

using accuracy::HardCase;
using brittle::Precision;
using engine::Result;

constexpr const char* kUsual = "as it is";
constexpr Precision kPrecisions[] = {Precision::Exact, Precision::Double, Precision::Fast};

struct Job {
    std::string name, setting;
    std::function<FractureCost(Trial&)> run; // a cost of nothing: by the clock
    support::MakeMover make_mover = {};      // none: Brittle moves scenes
};

// How much of what is allowed is used up.
double useOf(const Check& check) {
    if (check.allowed > 0) return check.value / check.allowed;
    return check.value > check.allowed ? std::numeric_limits<double>::infinity() : 0;
}

// Such as " (body 1, body 2)"; empty where no check of a single body fails.
std::string failingBodies(const std::vector<Check>& checks) {
    std::vector<std::string> names;
    for (const Check& check : checks)
        if (!check.holds() && !check.body.empty() && std::ranges::find(names, check.body) == names.end())
            names.push_back(check.body);
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? " (" : ", ") + name;
    return text.empty() ? text : text + ")";
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
    outcome.worst_kind = worst->what + failingBodies(checks);
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

void measureMotion(Trial& trial, const SceneCase& one) {
    if (judgesMotionAlone(one)) return one.measure(trial, one);
    trial.leaveOut("its checks ask for more than how bodies move");
}

void addScene(std::vector<Job>& jobs, const SceneCase& one, bool with_bullet) {
    addJob(jobs, one.name, [&one](Trial& trial) { one.measure(trial, one); });
    if (!with_bullet) return;
    addJob(jobs, one.name, [&one](Trial& trial) { measureMotion(trial, one); });
    jobs.back().setting = kBulletSetting;
    jobs.back().make_mover = bench::makeBulletMover;
}

void addOthers(std::vector<Job>& jobs, const RunOptions& options) {
    for (const MeshCase& one : meshCases())
        addJob(jobs, one.name, [&one](Trial& trial) { measureMesh(trial, one); });
    for (const PoolCase& one : poolCases())
        addJob(jobs, one.name, [&one](Trial& trial) { measurePool(trial, one); });
    for (const SceneCase& one : sceneCases())
        if (options.is_long || !one.is_long) addScene(jobs, one, options.with_bullet);
}

// Returns for example "x0.01".
std::string settingOf(double scale) {
    std::string text(32, '\0');
    text.resize(static_cast<size_t>(std::snprintf(text.data(), text.size(), "x%g", scale)));
    return text;
}

void addScaledScene(std::vector<Job>& jobs, const SceneCase& one, engine::Device& device, const RunOptions& options) {
    const auto add = [&](const std::string& setting, const support::MakeMover& make_inner) {
        addJob(jobs, one.name, [&one](Trial& trial) { measureMotion(trial, one); });
        jobs.back().setting = setting;
        jobs.back().make_mover = support::scaledMover(device, *options.scale, make_inner);
    };
    add(settingOf(*options.scale), {});
    if (options.with_bullet) add(kBulletSetting + (" " + settingOf(*options.scale)), bench::makeBulletMover);
}

void addLeftOut(std::vector<Job>& jobs, const std::string& name, const RunOptions& options) {
    addJob(jobs, name.c_str(), [](Trial& trial) { trial.leaveOut("it moves no scene"); });
    jobs.back().setting = settingOf(*options.scale);
}

void addScaled(std::vector<Job>& jobs, engine::Device& device, const RunOptions& options) {
    for (const FractureCase& one : fractureCases())
        addLeftOut(jobs, one.name, options);
    for (const MeshCase& one : meshCases())
        addLeftOut(jobs, one.name, options);
    for (const PoolCase& one : poolCases())
        addLeftOut(jobs, one.name, options);
    for (const SceneCase& one : sceneCases())
        if (options.is_long || !one.is_long) addScaledScene(jobs, one, device, options);
}

bool hasIn(const std::string& name, const std::string& only) { return name.find(only) != std::string::npos; }

engine::Error noCaseNamed(const std::string& only) {
    return {engine::ErrorCode::BadInput, "no hard case has \"" + only + "\" in its name; brittle hard --list names them all"};
}

Result<std::vector<Job>> jobsOf(engine::Device& device, const RunOptions& options) {
    std::vector<Job> jobs;
    if (options.scale) {
        addScaled(jobs, device, options);
    } else {
        auto made = brittle::Fracture::create(device);
        if (!made) return made.error();
        addFractures(jobs, std::shared_ptr<brittle::Fracture>(std::move(*made)));
        addOthers(jobs, options);
    }
    std::erase_if(jobs, [&](const Job& job) { return !hasIn(job.name, options.only); });
    if (jobs.empty()) return noCaseNamed(options.only);
    return jobs;
}

// None of what is left out, of which `watch` is told.
std::optional<HardCase> runJob(engine::Device& device, const Job& job, const RunWatch& watch) {
    Trial trial(device, job.make_mover);
    const auto begun = std::chrono::steady_clock::now();
    FractureCost cost = job.run(trial);
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begun;
    if (cost.ms == 0) cost.ms = taken.count();
    HardCase outcome = outcomeOf(job, trial, cost);
    if (!trial.isLeftOut()) {
        watch.ended(outcome);
        return outcome;
    }
    watch.left_out(outcome);
    return std::nullopt;
}

} // namespace

Result<std::vector<HardCase>> runHardCases(engine::Device& device, const RunOptions& options, const RunWatch& watch) {
    if (options.with_bullet && !bench::hasBullet())
        return engine::Error{engine::ErrorCode::Feature,
                             "this build has no Bullet; install libbullet-dev and build again, or leave out --bullet"};
    auto made = jobsOf(device, options);
    if (!made) return made.error();
    const std::vector<Job>& jobs = *made;
    std::vector<HardCase> outcomes;
    for (size_t k = 0; k < jobs.size(); ++k) {
        watch.begins({k, jobs.size(), jobs[k].name, jobs[k].setting});
        if (auto outcome = runJob(device, jobs[k], watch)) outcomes.push_back(std::move(*outcome));
    }
    return outcomes;
}

Result<std::vector<std::string>> hardCaseNames(const std::string& only) {
    std::vector<std::string> names;
    const auto add = [&](const std::string& name, bool is_long) {
        if (hasIn(name, only)) names.push_back(is_long ? name + " (long)" : name);
    };
    for (const FractureCase& one : fractureCases())
        add(one.name, false);
    for (const MeshCase& one : meshCases())
        add(one.name, false);
    for (const PoolCase& one : poolCases())
        add(one.name, false);
    for (const SceneCase& one : sceneCases())
        add(one.name, one.is_long);
    if (names.empty()) return noCaseNamed(only);
    return names;
}

} // namespace hard
