#include "tests/hard/long_motions.h"

#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <cmath>

namespace hard {
namespace {

using brittle::Double3;
using support::MeasuredScene;

double spinOf(const MeasuredScene& run, size_t body) {
    const gpu::BodyState& state = run.state(body);
    return brittle::length({state.spin.x, state.spin.y, state.spin.z});
}

double gravityOf(const MeasuredScene& run) { return brittle::length(run.scene().gravity); }

double massOf(const MeasuredScene& run, size_t body) { return 1 / double{run.state(body).offset.w}; }

// A falling body has the velocity that it had half a substep before, whoever moves it.
double squareOfSpeed(const MeasuredScene& run, size_t body) {
    const gpu::vec4& v = run.state(body).velocity;
    const double lag = 0.5 * run.substep();
    const Double3 now = brittle::operator+(Double3{v.x, v.y, v.z}, brittle::operator*(lag, run.scene().gravity));
    return brittle::dot(now, now);
}

// Kinetic and potential, in weights of a body above the ground.
double energyOf(const MeasuredScene& run, size_t body) {
    const gpu::BodyState& s = run.state(body);
    const double turning =
        0.5 * (double{s.spin.x} * s.momentum.x + double{s.spin.y} * s.momentum.y + double{s.spin.z} * s.momentum.z);
    return run.place(body)[1] + (0.5 * squareOfSpeed(run, body) + turning / massOf(run, body)) / gravityOf(run);
}

double heightOf(const brittle::ShapeDescription& shape) {
    if (shape.points.empty()) return shape.size[1];
    const auto [lowest, highest] = std::ranges::minmax(shape.points, {}, [](const Double3& p) { return p[1]; });
    return highest[1] - lowest[1];
}

} // namespace

// Each comes by within half a turn.
void hitTheirPosts(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    if (!trial.step(run, 4)) return;
    double missed = 0;
    for (size_t b = 0; b < run.scene().bodies.size(); ++b)
        missed += spinOf(run, b) > 59.9 ? 1 : 0;
    trial.check("rods that passed their post", missed, 0);
}

void keepsItsSpeed(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    if (trial.failure()) return;
    const double first = run.state(0).velocity.x, size = heightOf(run.scene().bodies[0].shape), height = run.place(0)[1];
    double lost = 0, off = 0;
    while (run.stepsLeft() > 0 && trial.step(run, 1)) {
        lost = std::max(lost, 1 - double{run.state(0).velocity.x} / first);
        off = std::max(off, std::fabs(run.place(0)[1] - height));
    }
    const double gained = double{run.state(0).velocity.x} / first - 1,
                 way = first * run.scene().step.steps * run.scene().step.dt;
    trial.check("speed, lost", lost, 1e-3);
    trial.check("speed, gained", gained, 1e-3);
    trial.check("way, off", std::fabs(run.way(0)[0] / way - 1), 1e-3);
    trial.check("height, off by a share of its size", off / size, 0.02);
    trial.check("way aside", std::fabs(run.way(0)[2]), 0.0025 * size, "m");
}

// A top is where a step ends higher than the ones before and after it; its energy gives the height between steps.
void keepsItsTops(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    if (trial.failure()) return;
    const double first = energyOf(run, 0) - 0.5;
    double highest = 0, lowest = 1e9;
    while (run.stepsLeft() > 0 && trial.step(run, 1)) {
        const double height = energyOf(run, 0) - 0.5;
        highest = std::max(highest, height);
        lowest = std::min(lowest, height);
    }
    trial.check("top, too high by a share", highest / first - 1, 0.02);
    trial.check("top, too low by a share", 1 - lowest / first, 0.02);
}

void keepTheirEnergy(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    if (trial.failure()) return;
    std::vector<double> first;
    for (size_t b = 0; b < run.bodyCount() && run.moves(b); ++b)
        first.push_back(energyOf(run, b));
    if (!trial.finish(run)) return;
    double gained = -1, lost = -1;
    for (size_t b = 0; b < first.size(); ++b) {
        gained = std::max(gained, energyOf(run, b) / first[b] - 1);
        lost = std::max(lost, 1 - energyOf(run, b) / first[b]);
    }
    trial.check("energy, gained", gained, 1e-3);
    trial.check("energy, lost", lost, 0.02);
}

void passTheBlowOn(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    if (trial.failure()) return;
    const double energy = run.kineticEnergy(), speed = run.speed(0);
    if (!trial.finish(run)) return;
    const size_t last = run.scene().bodies.size() - 1;
    double others = 0;
    for (size_t b = 0; b < last; ++b)
        others = std::max(others, run.speed(b));
    trial.check("speed of the last, off", std::fabs(double{run.state(last).velocity.x} / speed - 1), 1e-3);
    trial.check("speed of the others", others, 1e-3 * speed, "m/s");
    trial.check("energy, off", std::fabs(run.kineticEnergy() / energy - 1), 1e-3);
}

void archStands(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    if (!trial.finish(run)) return;
    trial.check("way of a stone", run.furthestWay(), self.parameter, "m");
    trial.check("speed", run.fastest(), 1e-3, "m/s");
}

// The wall's face is at 5 mm.
void stopWhereTheyTouch(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    const size_t count = run.scene().bodies.size();
    const auto gap = [&](size_t b) { return run.place(b)[2] - 0.005 - run.scene().bodies[b].shape.size[2] / 2; };
    std::vector<double> deepest(count, 1e9);
    while (run.stepsLeft() > 0 && trial.step(run, 1))
        for (size_t b = 0; b < count; ++b)
            deepest[b] = std::min(deepest[b], gap(b));
    if (trial.failure()) return;
    const double way = self.parameter * run.scene().step.dt; // in a step
    for (size_t b = 0; b < count; ++b) {
        const std::string body = "body " + std::to_string(b);
        trial.check("depth in the wall", std::max(-deepest[b], 0.0), 1e-4, "m", body);
        trial.check("place, off from where it touches", std::fabs(gap(b)), 1e-3 * way, "m", body);
        trial.check("speed that is left", run.speed(b), 1e-3 * self.parameter, "m/s", body);
        trial.check("turning", spinOf(run, b), 0.1, "rad/s", body);
    }
}

void liesForMinutes(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    if (trial.finish(run)) trial.check("way", run.furthestWay(), 1e-3, "m");
}

} // namespace hard
