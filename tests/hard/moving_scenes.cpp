#include "tests/hard/moving_scenes.h"

#include "modules/brittle/mesh/vector_math.h"
#include "tests/reference/boxes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hard {
namespace {

using brittle::Double3;
using brittle::operator-, brittle::operator*;
using support::MeasuredScene, support::percentile;

} // namespace

void spinsFreely(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    if (trial.failure()) return;
    const gpu::BodyState before = run.state(0);
    const Double3 first = {before.momentum.x, before.momentum.y, before.momentum.z};
    const double energy = run.kineticEnergy();
    double size = 0, direction = 0, lost = 0;
    for (int part = 0; part < 10 && trial.step(run, 60); ++part) {
        const Double3 now = run.angularMomentum();
        const double cosine = brittle::dot(now, first) / (brittle::length(now) * brittle::length(first));
        size = std::max(size, std::fabs(brittle::length(now) / brittle::length(first) - 1));
        direction = std::max(direction, std::acos(std::min(1.0, cosine)) * 180 / std::numbers::pi);
        lost = std::max(lost, std::fabs(run.kineticEnergy() / energy - 1));
    }
    trial.check("angular momentum, off", size, 1e-4);
    trial.check("its direction, off", direction, 0.1, "degrees");
    trial.check("energy, off", lost, 1e-3);
}

// The wall stands at 5 m.
void stopsAtTheWall(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    double beyond = -5, back = 0;
    for (int step = 0; step < 120 && trial.step(run, 1); ++step) {
        beyond = std::max(beyond, run.place(0)[0] - 5);
        if (step > 2) back = std::max(back, -double{run.state(0).velocity.x} / self.parameter);
    }
    trial.check("way beyond the wall", std::max(beyond, 0.0), 0, "m");
    trial.check("speed back, of what it came with", back, 0.01);
}

void pushesThePlate(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    if (trial.failure()) return;
    const double before = run.momentum()[0];
    double beyond = 0;
    for (int step = 0; step < 120 && trial.step(run, 1); ++step)
        beyond = std::max(beyond, run.place(0)[0] - run.place(1)[0]);
    trial.check("way beyond the plate", beyond, 0, "m");
    trial.check("momentum, off", std::fabs(run.momentum()[0] / before - 1), 1e-6);
}

void bouncesBack(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    if (trial.failure()) return;
    const double first = run.state(0).velocity.x, second = run.state(1).velocity.x;
    if (!trial.finish(run)) return;
    trial.check("speed of the first, off", std::fabs(run.state(0).velocity.x / first + 1), 1e-3);
    trial.check("speed of the second, off", std::fabs(run.state(1).velocity.x / second + 1), 1e-3);
}

void holdsOnTheSlope(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    if (!trial.step(run, 300)) return;
    const Double3 before = run.place(0);
    if (trial.step(run, 300)) trial.check("creeping", brittle::length(run.place(0) - before), 1e-4, "m");
}

void slidesDownTheSlope(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    if (!trial.finish(run)) return;
    trial.check("way, off by a share", std::fabs(brittle::length(run.way(0)) / 22.36 - 1), 0.02);
}

// The highest that the middle comes after the bounce, above where it rests.
void bounces(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    double last = 1e9, apex = 0;
    bool risen = false;
    while (run.stepsLeft() > 0 && trial.step(run, 1)) {
        const double y = run.place(0)[1] - 0.5;
        if (risen && y < last) break;
        risen = risen || y > last;
        if (risen) apex = std::max(apex, y);
        last = y;
    }
    trial.check("height after the bounce, off by a share", std::fabs(apex / self.parameter - 1), 0.02);
}

// Momenta are compared with the sum of the sizes of those of all bodies, which cancel at the start.
void implodes(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    if (trial.failure()) return;
    const double energy = run.kineticEnergy(), all = run.momentumInAll(), all_angular = run.angularMomentumInAll();
    const Double3 linear = run.momentum(), angular = run.angularMomentum();
    double most = 0;
    while (run.stepsLeft() > 0 && trial.step(run, std::min(5u, run.stepsLeft())))
        most = std::max(most, run.kineticEnergy());
    trial.check("kinetic energy, of that at the start", most / energy, 1);
    trial.check("momentum, off", brittle::length(run.momentum() - linear) / all, 1e-7);
    trial.check("angular momentum, off", brittle::length(run.angularMomentum() - angular) / all_angular, 2e-4);
}

void movesAlikeFarAway(Trial& trial, const SceneCase& self) {
    MeasuredScene &near = trial.scene("hard_19_far_0km"), &far = trial.scene(self.name);
    if (!trial.step(near, 300) || !trial.step(far, 300)) return;
    double most = 0;
    for (size_t b = 0; b < near.scene().bodies.size(); ++b)
        most = std::max(most, brittle::length(near.way(b) - far.way(b)));
    trial.check("ways, off from those at the origin", most, 1e-3, "m");
}

// What must be found for certain, and what may be, by boxes that are a little smaller and larger than those of the step.
void findsAllPairs(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    if (!trial.step(run, 1)) return;
    const auto found = run.world().pairs();
    if (!found) return trial.fail(found.error().message);
    const auto must = reference::pairsThatMeet(run.sweptBoxes(-1e-4)), may = reference::pairsThatMeet(run.sweptBoxes(1e-4));
    const auto missing = [](const auto& of, const auto& in) {
        return static_cast<double>(
            std::ranges::count_if(of, [&](const auto& p) { return !std::ranges::binary_search(in, p); }));
    };
    trial.check("pairs out of order", std::ranges::is_sorted(*found) ? 0 : 1, 0);
    trial.check("pairs missing", missing(must, *found), 0);
    trial.check("pairs that do not meet", missing(*found, may), 0);
}

} // namespace hard
