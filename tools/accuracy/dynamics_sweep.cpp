// Dynamics: every knob of a step, on scenes whose end is known. The worlds of all settings go on side by side, a tenth of a
// second of the scene each in turn, and then all of it again from the beginning.
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "modules/brittle/scene/scene_file.h"
#include "tools/accuracy/dynamics_settings.h"
#include "tools/accuracy/embedded_files.h"
#include "tools/accuracy/scene_truth.h"
#include "tools/accuracy/sweep.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace accuracy {
namespace {

using brittle::StepSettings;
using engine::Result;

constexpr double kFrame = 1.0 / 60; // s
constexpr const char* kShotScene = "hard_10_wall_300";
constexpr uint32_t kWindowFragments = 256; // room for them, which there are more of than a pane becomes
constexpr uint32_t kFine = 64;             // times shorter steps
constexpr uint32_t kFewestRounds = 2;      // the least that tell how far a time can be trusted

struct DynamicsWorkload {
    const char *name, *quick_scene, *full_scene, *what;
    uint32_t scene;                            // one of ScenesFor
    uint32_t quick_frames, full_frames, block; // frames; a turn's, even, since a step may be two of them
    uint32_t fine_frames;                      // how long the fine run goes; 0: there is none
    MakeTruth truth;
    std::vector<const ErrorKind*> kinds;
    double share;
};

const DynamicsWorkload kWorkloads[] = {
    {"pile",
     "hull_pile_100",
     "hull_pile_1000",
     "Random hulls fall into a pit and come to rest",
     kPile,
     72,
     180,
     12,
     36,
     pileTruth,
     {&kinds::kPenetration, &kinds::kEnergy, &kinds::kTrajectory},
     .54},
    {"stack",
     "stack_10",
     "stack_40",
     "A stack of cubes stands",
     kStack,
     60,
     180,
     6,
     0,
     stackTruth,
     {&kinds::kDrift, &kinds::kPenetration},
     .14},
    {"spin",
     "hard_08_intermediate_axis",
     "hard_08_intermediate_axis",
     "A box turns about its middle axis, which it cannot keep to; nothing touches it",
     kSpin,
     60,
     300,
     6,
     0,
     spinTruth,
     {&kinds::kTurn, &kinds::kEnergy, &kinds::kMomentum},
     .01},
    {"bounce",
     "hard_17_bounce_50",
     "hard_17_bounce_50",
     "A cube falls flat from 2 m and bounces half as fast",
     kBounce,
     72,
     72,
     2,
     0,
     bounceTruth,
     {&kinds::kHeight},
     .12},
    {"shot",
     "hard_10_wall_300",
     "hard_10_wall_300",
     "A cube of 10 cm flies at a wall of 5 cm, at 300 m/s",
     kShot,
     12,
     12,
     2,
     0,
     shotTruth,
     {&kinds::kBeyond},
     .02},
    {"window",
     kWindowScene,
     kWindowScene,
     "A ball breaks a window pane in its frame",
     kWindow,
     12,
     60,
     2,
     10,
     windowTruth,
     {&kinds::kTrajectory},
     .17},
};

// Where the cube would meet the wall flat, which is no trial.
void throwRodAslant(brittle::BodyDescription& shot) {
    shot.shape.size = {0.6, 0.05, 0.05};
    shot.turn = {0.3, 0.2, 0.5, 0.8};
    shot.spin = {50, 0, 50};
}

Result<SceneStart> startOf(Sweep& sweep, const std::string& name) {
    auto scene = name == kWindowScene ? brittle::readScene(embeddedFile(kWindowScene), name) : brittle::makeBuiltinScene(name);
    if (!scene) return scene.error();
    if (name == kShotScene) throwRodAslant(scene->bodies.front());
    if (name == kWindowScene) scene->budgets.fragments = kWindowFragments;
    const auto fracture = brittle::fractureFor(*scene, sweep.device, sweep.options.group_size);
    if (!fracture) return fracture.error();
    auto contents = brittle::contentsOf(*scene, ".", fracture->get());
    if (!contents) return contents.error();
    return SceneStart{std::move(*scene), std::move(*contents)};
}

uint32_t stepsIn(uint32_t frames, double dt) { return static_cast<uint32_t>(std::lround(frames * kFrame / dt)); }

Result<Moment> momentOf(brittle::World& world, double seconds) {
    auto bodies = world.bodies();
    if (!bodies) return bodies.error();
    return Moment{seconds, std::move(*bodies)};
}

// One setting of the scene.
struct Candidate {
    StepSettings settings;
    std::unique_ptr<brittle::World> world;
    std::unique_ptr<SceneTruth> truth;
    std::vector<std::byte> start;
    Measurement measurement;
    std::vector<double> ms; // a frame, by round
    double round_ms = 0;
};

class SceneRun {
public:
    SceneRun(Sweep& sweep, const DynamicsWorkload& workload, SceneStart start, double before)
        : sweep_(sweep), workload_(workload), start_(std::move(start)), before_(before),
          frames_(sweep.options.is_quick ? workload.quick_frames : workload.full_frames) {}

    Result<void> run() {
        if (auto made = runFine(); !made) return made;
        for (const DynamicsSetting& setting : dynamicsSettings())
            if ((setting.scenes & workload_.scene) != 0)
                if (auto added = addCandidate(setting); !added) return added;
        uint32_t round = 0;
        for (; round < sweep_.options.sceneRounds() && !(round >= kFewestRounds && sweep_.isLate()); ++round)
            if (auto done = runRound(round); !done) return done;
        sweep_.results.machine.scene_rounds = std::min(sweep_.results.machine.scene_rounds, round);
        for (Candidate& candidate : candidates_) {
            candidate.measurement.ms = samplesOf(std::move(candidate.ms));
            if (candidate.measurement.failed.empty()) candidate.measurement.errors = candidate.truth->errors();
            sweep_.results.measurements.push_back(std::move(candidate.measurement));
        }
        return {};
    }

private:
    Result<std::unique_ptr<brittle::World>> worldOf(const StepSettings& settings) const {
        return brittle::World::create(sweep_.device, start_.contents, settings,
                                      brittle::budgetOf(start_.scene, sweep_.options.group_size));
    }

    // At every block, with steps shorter by `finer`.
    Result<std::vector<Moment>> momentsAt(uint32_t finer) {
        auto settings = brittle::settingsOf(start_.scene);
        if (!settings) return settings.error();
        settings->dt = kFrame / finer;
        auto world = worldOf(*settings);
        if (!world) return world.error();
        std::vector<Moment> moments;
        for (uint32_t frame = workload_.block; frame <= workload_.fine_frames; frame += workload_.block) {
            sweep_.progress.show(std::string(workload_.name) + ", dt/" + std::to_string(finer), before_);
            if (auto done = (*world)->step(workload_.block * finer); !done) return done.error();
            auto moment = momentOf(**world, frame * kFrame);
            if (!moment) return moment.error();
            moments.push_back(std::move(*moment));
        }
        return moments;
    }

    // What steps twice as long are off by, is what the fine run resolves.
    Result<void> runFine() {
        if (workload_.fine_frames == 0) return {};
        auto fine = momentsAt(kFine);
        if (!fine) return fine.error();
        const auto coarser = momentsAt(kFine / 2);
        if (!coarser) return coarser.error();
        fine_.moments = std::move(*fine);
        const auto truth = workload_.truth(start_, fine_);
        for (const Moment& moment : *coarser)
            truth->see(moment);
        for (const MeasuredError& error : truth->errors())
            if (error.kind == kinds::kTrajectory.name) fine_.resolution = error.value;
        return {};
    }

    Result<void> addCandidate(const DynamicsSetting& setting) {
        sweep_.progress.show(std::string(workload_.name) + ", " + setting.knob + " " + setting.setting, before_);
        auto settings = brittle::settingsOf(start_.scene);
        if (!settings) return settings.error();
        Candidate& candidate = candidates_.emplace_back();
        candidate.settings = *settings;
        setting.apply(candidate.settings);
        candidate.measurement.workload = workload_.name;
        candidate.measurement.knob = setting.knob;
        candidate.measurement.setting = setting.setting;
        candidate.measurement.loses = setting.loses;
        candidate.measurement.is_default = candidates_.size() == 1;
        auto world = worldOf(candidate.settings);
        if (!world) return noteFailure(candidate, world.error());
        candidate.world = std::move(*world);
        candidate.truth = workload_.truth(start_, fine_);
        const auto plan = candidate.world->plan();
        if (!plan) return plan.error();
        candidate.measurement.bytes = static_cast<double>(plan->bytes());
        return warmUp(candidate);
    }

    // Two steps make drivers compile what they have put off; then everything is as it was.
    static Result<void> warmUp(Candidate& candidate) {
        auto start = candidate.world->save();
        if (!start) return start.error();
        candidate.start = std::move(*start);
        return candidate.world->step(2);
    }

    Result<void> runRound(uint32_t round) {
        for (Candidate& candidate : candidates_) {
            if (!candidate.measurement.failed.empty()) continue;
            candidate.round_ms = 0;
            if (auto restored = candidate.world->restore(candidate.start); !restored) return restored;
            if (round == 0)
                if (auto seen = see(candidate, 0); !seen) return seen;
        }
        size_t turn = round;
        for (uint32_t frame = 0; frame < frames_; frame += workload_.block) {
            const double done = (round + double(frame) / frames_) / sweep_.options.sceneRounds();
            sweep_.progress.show(workload_.name, before_ + workload_.share * done);
            for (size_t k = 0; k < candidates_.size(); ++k) { // another one begins each turn
                Candidate& candidate = candidates_[(k + turn) % candidates_.size()];
                if (auto stepped = stepBlock(candidate, frame + workload_.block, round == 0); !stepped) return stepped;
            }
            ++turn;
        }
        for (Candidate& candidate : candidates_)
            if (candidate.measurement.failed.empty()) candidate.ms.push_back(candidate.round_ms / frames_);
        return {};
    }

    Result<void> stepBlock(Candidate& candidate, uint32_t end, bool is_first_round) {
        if (!candidate.measurement.failed.empty()) return {};
        const auto begin = std::chrono::steady_clock::now();
        const auto done = candidate.world->step(stepsIn(workload_.block, candidate.settings.dt));
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
        if (!done) return noteFailure(candidate, done.error());
        candidate.round_ms += taken.count();
        return is_first_round ? see(candidate, end * kFrame) : Result<void>();
    }

    // Without its default a workload has nothing to compare with.
    static Result<void> noteFailure(Candidate& candidate, const engine::Error& error) {
        if (candidate.measurement.is_default) return error;
        candidate.measurement.failed = error.message;
        return {};
    }

    static Result<void> see(Candidate& candidate, double seconds) {
        const auto moment = momentOf(*candidate.world, seconds);
        if (!moment) return moment.error();
        candidate.truth->see(*moment);
        return {};
    }

    Sweep& sweep_;
    const DynamicsWorkload& workload_;
    SceneStart start_;
    FineRun fine_;
    double before_;
    uint32_t frames_;
    std::vector<Candidate> candidates_;
};

Workload described(const DynamicsWorkload& workload, const char* scene) {
    Workload out = {workload.name,
                    "dynamics",
                    std::string(workload.what) + " (" + scene + ")",
                    "a frame of a sixtieth of a second, with the wait for it",
                    "on the device, of the world",
                    {}};
    for (const ErrorKind* kind : workload.kinds)
        out.kinds.push_back(kind->name);
    return out;
}

} // namespace

Result<void> sweepDynamics(Sweep& sweep) {
    double before = 0;
    for (const DynamicsWorkload& workload : kWorkloads) {
        for (const ErrorKind* kind : workload.kinds)
            addKind(sweep.results, *kind);
        const char* scene = sweep.options.is_quick ? workload.quick_scene : workload.full_scene;
        auto start = startOf(sweep, scene);
        if (!start) return start.error();
        sweep.results.workloads.push_back(described(workload, scene));
        if (auto done = SceneRun(sweep, workload, std::move(*start), before).run(); !done)
            return engine::Error{done.error().code, std::string(workload.name) + ": " + done.error().message};
        before += workload.share;
    }
    return {};
}

} // namespace accuracy
