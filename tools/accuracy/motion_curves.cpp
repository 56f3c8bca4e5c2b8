// Motion against time and settings, by both solvers: energy over a minute, how stacks sway if substeps are few, and how far
// heavy cubes on light ones are off.
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/support/body_overlaps.h"
#include "tools/accuracy/sweep.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace accuracy {
namespace {

using brittle::Double3;
using brittle::SolverKind;
using brittle::operator+, brittle::operator-, brittle::operator*;
using engine::Result;

constexpr double kSecond = 60;  // steps
constexpr double kLeast = 1e-6; // shown instead of less, where an axis is logarithmic

struct SolverName {
    SolverKind kind;
    const char* name;
};
constexpr SolverName kSolvers[] = {{SolverKind::Soft, "soft"}, {SolverKind::Hard, "hard"}};

Double3 xyz(const gpu::vec4& v) { return {v.x, v.y, v.z}; }
Double3 placeOf(const gpu::BodyState& body) { return support::poseOf(body).place; }
bool moves(const gpu::BodyState& body) { return body.offset.w > 0; }

// A scene that is stepped and read back.
class Motion {
public:
    static Result<Motion> begin(Sweep& sweep, brittle::SceneDescription scene) {
        const auto contents = brittle::contentsOf(scene, ".", nullptr);
        if (!contents) return contents.error();
        const auto settings = brittle::settingsOf(scene);
        if (!settings) return settings.error();
        auto world =
            brittle::World::create(sweep.device, *contents, *settings, brittle::budgetOf(scene, sweep.options.group_size));
        if (!world) return world.error();
        Motion motion(std::move(scene), std::move(*world), 0.5 * settings->dt / settings->substeps);
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

    const gpu::BodyState& body(size_t k) const { return bodies_[k]; }
    const brittle::SceneDescription& scene() const { return scene_; }
    double msOfAStep() const { return samplesOf(ms_).median; }

    // J, of motion and of height. Speeds lag places by half a substep.
    double energy() const {
        double sum = 0;
        for (const gpu::BodyState& body : bodies_) {
            if (!moves(body)) continue;
            const double mass = 1 / double{body.offset.w};
            const Double3 velocity = xyz(body.velocity) + lag_ * scene_.gravity;
            sum += 0.5 * mass * brittle::dot(velocity, velocity) + 0.5 * brittle::dot(xyz(body.momentum), xyz(body.spin)) -
                   mass * brittle::dot(scene_.gravity, placeOf(body));
        }
        return sum;
    }

    double fastest() const {
        double most = 0;
        for (const gpu::BodyState& body : bodies_)
            if (moves(body)) most = std::max(most, brittle::length(xyz(body.velocity)));
        return most;
    }

private:
    Motion(brittle::SceneDescription scene, std::unique_ptr<brittle::World> world, double lag)
        : scene_(std::move(scene)), world_(std::move(world)), lag_(lag) {}

    Result<void> look() {
        auto bodies = world_->bodies();
        if (!bodies) return bodies.error();
        bodies_ = std::move(*bodies);
        return {};
    }

    brittle::SceneDescription scene_;
    std::unique_ptr<brittle::World> world_;
    std::vector<gpu::BodyState> bodies_;
    std::vector<double> ms_;
    double lag_; // s
};

Result<brittle::SceneDescription> sceneOf(const char* name, SolverKind solver) {
    auto scene = brittle::makeBuiltinScene(name);
    if (!scene) return scene.error();
    scene->step.solver = solver;
    return scene;
}

CurveSeries seriesOf(const std::string& what, const SolverName& solver) {
    return {what + ", " + solver.name + " solver", {}, ""};
}

class CurveRun {
public:
    explicit CurveRun(Sweep& sweep) : sweep_(sweep), is_quick_(sweep.options.is_quick) {}

    Result<void> run() {
        if (auto drawn = drawEnergy(); !drawn) return drawn;
        if (auto drawn = drawSway(); !drawn) return drawn;
        return drawRatios();
    }

private:
    struct Watched {
        const char *scene, *what;
    };

    void show(const std::string& what, double done) const { sweep_.progress.show(what, done); }

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
        double done = 0;
        for (const Watched& watched : kScenes)
            for (const SolverName& solver : kSolvers) {
                show(std::string("energy of ") + watched.what, done);
                CurveSeries series = seriesOf(watched.what, solver);
                if (auto followed = followEnergy(watched.scene, solver.kind, series); !followed) return followed;
                curve.series.push_back(std::move(series));
                done += 0.05;
            }
        sweep_.results.curves.push_back(std::move(curve));
        return {};
    }

    // The most that it is off by in each interval.
    Result<void> followEnergy(const char* name, SolverKind solver, CurveSeries& series) const {
        auto scene = sceneOf(name, solver);
        if (!scene) return scene.error();
        auto motion = Motion::begin(sweep_, std::move(*scene));
        if (!motion) return motion.error();
        const double seconds = is_quick_ ? 6 : 60, every = is_quick_ ? 1 : 3, first = motion->energy();
        constexpr uint32_t kAtOnce = 6;
        for (double end = every; end <= seconds; end += every) {
            double most = 0;
            for (double step = 0; step < every * kSecond; step += kAtOnce) {
                if (auto stepped = motion->step(kAtOnce); !stepped) return stepped;
                most = std::max(most, std::fabs(motion->energy() / first - 1));
            }
            series.points.push_back({end, 100 * most});
        }
        return {};
    }

    Result<void> drawSway() {
        constexpr Watched kStacks[] = {{"hard_34_stack_8_of_1m", "8 cubes of 1 m"},
                                       {"hard_34_stack_10_of_5cm", "10 cubes of 5 cm"}};
        const std::string time = std::to_string(swaySeconds());
        Curve sway{"sway",
                   "How stacks sway, by the substeps that they may take",
                   "What moves fastest " + time +
                       " s after the start, in edges a second. A stack takes as many substeps as it "
                       "calls for and most_substeps allows; below a thousandth it counts as still.",
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
        double done = 0.3;
        for (const Watched& stack : kStacks)
            for (const SolverName& solver : kSolvers) {
                CurveSeries speeds = seriesOf(stack.what, solver), prices = speeds;
                for (const uint32_t most :
                     is_quick_ ? std::vector<uint32_t>{4, 16, 64} : std::vector<uint32_t>{4, 8, 16, 32, 64, 128}) {
                    show(std::string("stack of ") + stack.what, done);
                    if (auto seen = watchStack(stack.scene, solver.kind, most, speeds, prices); !seen) return seen;
                }
                sway.series.push_back(std::move(speeds));
                price.series.push_back(std::move(prices));
                done += 0.1;
            }
        sweep_.results.curves.push_back(std::move(sway));
        sweep_.results.curves.push_back(std::move(price));
        return {};
    }

    int swaySeconds() const { return is_quick_ ? 2 : 60; }

    Result<void> watchStack(const char* name, SolverKind solver, uint32_t most, CurveSeries& speeds,
                            CurveSeries& prices) const {
        auto scene = sceneOf(name, solver);
        if (!scene) return scene.error();
        scene->step.most_substeps = most;
        const double edge = scene->bodies.front().shape.size[0];
        auto motion = Motion::begin(sweep_, std::move(*scene));
        if (!motion) return motion.error();
        for (int second = 0; second < swaySeconds(); ++second)
            if (auto stepped = motion->step(static_cast<uint32_t>(kSecond)); !stepped) return stepped;
        speeds.points.push_back({double(most), std::max(motion->fastest() / edge, kLeast)});
        prices.points.push_back({double(most), motion->msOfAStep()});
        return {};
    }

    Result<void> drawRatios() {
        constexpr Watched kCases[] = {{"hard_35_placed_10", "placed"}, {"hard_35_dropped_10", "dropped by 0.1 m"}};
        const std::string time = std::to_string(ratioSeconds());
        Curve curve{"ratios",
                    "A heavy cube on a light one",
                    "How far the upper one is from its place " + time +
                        " s after the start. Cubes of 1 m; the lower one has 1 kg. "
                        "It should lie 1.5 m high.",
                    "ratio of masses",
                    "off by, mm",
                    true,
                    true,
                    {}};
        double done = 0.7;
        for (const Watched& one : kCases)
            for (const SolverName& solver : kSolvers) {
                CurveSeries series = seriesOf(one.what, solver);
                for (const double ratio :
                     is_quick_ ? std::vector<double>{3, 300} : std::vector<double>{2, 5, 10, 30, 100, 300, 1000}) {
                    show(std::string("heavy on light, ") + one.what, done);
                    if (auto seen = watchHeavy(one.scene, solver.kind, ratio, series); !seen) return seen;
                }
                curve.series.push_back(std::move(series));
                done += 0.07;
            }
        sweep_.results.curves.push_back(std::move(curve));
        return {};
    }

    int ratioSeconds() const { return is_quick_ ? 2 : 10; }

    Result<void> watchHeavy(const char* name, SolverKind solver, double ratio, CurveSeries& series) const {
        auto scene = sceneOf(name, solver);
        if (!scene) return scene.error();
        scene->bodies.back().mass = ratio;
        auto motion = Motion::begin(sweep_, std::move(*scene));
        if (!motion) return motion.error();
        for (int second = 0; second < ratioSeconds(); ++second)
            if (auto stepped = motion->step(static_cast<uint32_t>(kSecond)); !stepped) return stepped;
        const Double3 off = placeOf(motion->body(1)) - Double3{0, 1.5, 0};
        series.points.push_back({ratio, std::max(1000 * brittle::length(off), kLeast)});
        return {};
    }

    Sweep& sweep_;
    bool is_quick_;
};

} // namespace

Result<void> drawCurves(Sweep& sweep) { return CurveRun(sweep).run(); }

} // namespace accuracy
