// Motion against time and settings, by both solvers: energy over a minute, how stacks sway if substeps are few, and how far
// heavy cubes on light ones are off.
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tools/accuracy/scene_truth.h"
#include "tools/accuracy/sweep.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace accuracy {
namespace {

using brittle::Double3;
using brittle::SolverKind;
using brittle::operator-;
using engine::Result;

constexpr uint32_t kSecond = 60; // steps
constexpr double kLeast = 1e-6;  // shown instead of less, where an axis is logarithmic

struct SolverName {
    SolverKind kind;
    const char* name;
};
constexpr SolverName kSolvers[] = {{SolverKind::Soft, "soft"}, {SolverKind::Hard, "hard"}};

struct Watched {
    const char *scene, *what;
};

// A built-in scene that is stepped and read back.
class Motion {
public:
    static Result<Motion> begin(Sweep& sweep, const brittle::SceneDescription& scene) {
        const auto contents = brittle::contentsOf(scene, ".", nullptr);
        if (!contents) return contents.error();
        const auto settings = brittle::settingsOf(scene);
        if (!settings) return settings.error();
        auto world =
            brittle::World::create(sweep.device, *contents, *settings, brittle::budgetOf(scene, sweep.options.group_size));
        if (!world) return world.error();
        Motion motion(std::move(*world), *settings);
        if (auto seen = motion.look(); !seen) return seen.error();
        return motion;
    }

    Result<void> step(uint32_t steps) {
        const auto begun = std::chrono::steady_clock::now();
        if (auto done = world_->step(steps); !done) return done;
        if (auto seen = look(); !seen) return seen;
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begun;
        ms_.push_back(taken.count() / steps);
        return {};
    }

    Result<void> stepSeconds(uint32_t seconds) {
        for (uint32_t second = 0; second < seconds; ++second)
            if (auto stepped = step(kSecond); !stepped) return stepped;
        return {};
    }

    Double3 placeOf(size_t body) const { return brittle::poseOf(bodies_[body]).place; }
    double msOfAStep() const { return samplesOf(ms_).median; }
    double energy() const { return mechanicalEnergy(gravity_, bodies_, lag_); }

    double fastest() const {
        double most = 0;
        for (const gpu::BodyState& body : bodies_)
            most = std::max(most, brittle::length({body.velocity.x, body.velocity.y, body.velocity.z}));
        return most;
    }

private:
    Motion(std::unique_ptr<brittle::World> world, const brittle::StepSettings& settings)
        : world_(std::move(world)), gravity_(settings.gravity), lag_(0.5 * settings.dt / settings.substeps) {}

    Result<void> look() {
        auto bodies = world_->bodies();
        if (!bodies) return bodies.error();
        bodies_ = std::move(*bodies);
        return {};
    }

    std::unique_ptr<brittle::World> world_;
    Double3 gravity_;
    double lag_; // of speeds behind places, s
    std::vector<gpu::BodyState> bodies_;
    std::vector<double> ms_;
};

class CurveRun {
public:
    explicit CurveRun(Sweep& sweep) : sweep_(sweep), is_quick_(sweep.options.is_quick) {}

    Result<void> run() {
        if (auto drawn = drawEnergy(); !drawn) return drawn;
        if (auto drawn = drawSway(); !drawn) return drawn;
        return drawRatios();
    }

private:
    // Each scene by each solver, a series of the curve each. `before`, `share`: of the progress. `draw` adds points to it.
    template <class Draw>
    Result<void> addSeries(Curve& curve, std::span<const Watched> scenes, double before, double share, const Draw& draw) {
        const double each = share / static_cast<double>(scenes.size() * std::size(kSolvers));
        for (const Watched& watched : scenes) {
            auto scene = brittle::makeBuiltinScene(watched.scene);
            if (!scene) return scene.error();
            for (const SolverName& solver : kSolvers) {
                sweep_.progress.show(curve.title + ", " + watched.what, before);
                scene->step.solver = solver.kind;
                CurveSeries series{std::string(watched.what) + ", " + solver.name + " solver", {}};
                if (auto drawn = draw(*scene, series); !drawn) return drawn;
                curve.series.push_back(std::move(series));
                before += each;
            }
        }
        return {};
    }

    Result<void> drawEnergy() {
        constexpr Watched kScenes[] = {{"hard_37_elastic_2", "a cube that bounces"},
                                       {"hard_08_intermediate_axis", "a box that turns freely"},
                                       {"hard_34_stack_8_of_1m", "a stack of 8"}};
        Curve curve{
            "energy",
            "Energy over a minute",
            "By how much the energy of motion and of height differs from that at the start. The cube falls 2 m and bounces "
            "with restitution 1; the box turns about its middle axis and touches nothing; the stack of cubes of 1 m stands.",
            "time, s",
            "energy, off by %",
            false,
            false,
            {}};
        const auto follow = [&](const brittle::SceneDescription& scene, CurveSeries& series) {
            return followEnergy(scene, series);
        };
        if (auto drawn = addSeries(curve, kScenes, 0, 0.3, follow); !drawn) return drawn;
        sweep_.results.curves.push_back(std::move(curve));
        return {};
    }

    // The most that it is off by in each interval.
    Result<void> followEnergy(const brittle::SceneDescription& scene, CurveSeries& series) const {
        auto motion = Motion::begin(sweep_, scene);
        if (!motion) return motion.error();
        const double first = motion->energy();
        const uint32_t seconds = is_quick_ ? 6 : 60, every = is_quick_ ? 1 : 3;
        constexpr uint32_t kAtOnce = 6;
        for (uint32_t end = every; end <= seconds; end += every) {
            double most = 0;
            for (uint32_t step = 0; step < every * kSecond; step += kAtOnce) {
                if (auto stepped = motion->step(kAtOnce); !stepped) return stepped;
                most = std::max(most, std::fabs(motion->energy() / first - 1));
            }
            series.points.push_back({double(end), 100 * most});
        }
        return {};
    }

    Result<void> drawSway() {
        constexpr Watched kStacks[] = {{"hard_34_stack_8_of_1m", "8 cubes of 1 m"},
                                       {"hard_34_stack_10_of_5cm", "10 cubes of 5 cm"}};
        const uint32_t seconds = is_quick_ ? 2 : 60;
        Curve sway{"sway",
                   "How stacks sway, by the substeps that they may take",
                   "What moves fastest " + std::to_string(seconds) +
                       " s after the start, in edges a second. A stack takes the substeps that it needs, "
                       "at most most_substeps; below a thousandth it counts as still.",
                   "most_substeps",
                   "speed, edges/s",
                   true,
                   true,
                   {}};
        Curve price{"sway_price",
                    "What those substeps cost",
                    "The stacks of the plot before, on the device, with the wait for it.",
                    "most_substeps",
                    "ms a step",
                    true,
                    true,
                    {}};
        const auto watch = [&](const brittle::SceneDescription& scene, CurveSeries& speeds) {
            CurveSeries prices{speeds.label, {}};
            auto watched = watchStack(scene, seconds, speeds, prices);
            price.series.push_back(std::move(prices));
            return watched;
        };
        if (auto drawn = addSeries(sway, kStacks, 0.3, 0.4, watch); !drawn) return drawn;
        sweep_.results.curves.push_back(std::move(sway));
        sweep_.results.curves.push_back(std::move(price));
        return {};
    }

    Result<void> watchStack(brittle::SceneDescription scene, uint32_t seconds, CurveSeries& speeds, CurveSeries& prices) const {
        const double edge = scene.bodies.front().shape.size[0];
        for (const uint32_t most :
             is_quick_ ? std::vector<uint32_t>{4, 16, 64} : std::vector<uint32_t>{4, 8, 16, 32, 64, 128}) {
            scene.step.most_substeps = most;
            auto motion = Motion::begin(sweep_, scene);
            if (!motion) return motion.error();
            if (auto stepped = motion->stepSeconds(seconds); !stepped) return stepped;
            speeds.points.push_back({double(most), std::max(motion->fastest() / edge, kLeast)});
            prices.points.push_back({double(most), motion->msOfAStep()});
        }
        return {};
    }

    Result<void> drawRatios() {
        constexpr Watched kCases[] = {{"hard_35_placed_10", "placed"}, {"hard_35_dropped_10", "dropped by 0.1 m"}};
        const uint32_t seconds = is_quick_ ? 2 : 10;
        Curve curve{"ratios",
                    "A heavy cube on a light one",
                    "How far the upper one is from its place " + std::to_string(seconds) +
                        " s after the start. Cubes of 1 m; the lower one has 1 kg. It should lie 1.5 m high.",
                    "ratio of masses",
                    "off by, mm",
                    true,
                    true,
                    {}};
        const auto watch = [&](const brittle::SceneDescription& scene, CurveSeries& series) {
            return watchHeavy(scene, seconds, series);
        };
        if (auto drawn = addSeries(curve, kCases, 0.7, 0.3, watch); !drawn) return drawn;
        sweep_.results.curves.push_back(std::move(curve));
        return {};
    }

    Result<void> watchHeavy(brittle::SceneDescription scene, uint32_t seconds, CurveSeries& series) const {
        for (const double ratio : is_quick_ ? std::vector<double>{3, 300} : std::vector<double>{2, 5, 10, 30, 100, 300, 1000}) {
            scene.bodies.back().mass = ratio;
            auto motion = Motion::begin(sweep_, scene);
            if (!motion) return motion.error();
            if (auto stepped = motion->stepSeconds(seconds); !stepped) return stepped;
            const Double3 off = motion->placeOf(1) - Double3{0, 1.5, 0};
            series.points.push_back({ratio, std::max(1000 * brittle::length(off), kLeast)});
        }
        return {};
    }

    Sweep& sweep_;
    bool is_quick_;
};

} // namespace

Result<void> drawCurves(Sweep& sweep) { return CurveRun(sweep).run(); }

} // namespace accuracy
