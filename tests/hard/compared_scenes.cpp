// Hard scenes that are compared with themselves: in another order, at other weights and sizes, after being saved.
#include "modules/brittle/dynamics/body_order.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/hard/moving_scenes.h"
#include "tests/support/scaled_scene.h"
#include "tests/support/stacked_boxes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hard {
namespace {

using brittle::Double3, brittle::World, brittle::WorldContents;
using brittle::operator-, brittle::operator*;
using support::MeasuredScene;

std::unique_ptr<World> worldOf(Trial& trial, const WorldContents& contents, uint32_t group_size) {
    auto world = World::create(trial.device(), contents, {}, {0, 0, group_size});
    if (world) return std::move(*world);
    trial.fail(world.error().message);
    return nullptr;
}

// 0 after a failure.
uint64_t hashAfter(Trial& trial, World* world, uint32_t steps) {
    if (trial.failure()) return 0;
    if (const auto done = world->step(steps); !done) trial.fail(done.error().message);
    const auto hash = world->hash();
    if (!hash) trial.fail(hash.error().message);
    return hash ? *hash : 0;
}

void checkSame(Trial& trial, const char* what, uint64_t hash, uint64_t expected) {
    trial.check(std::string("hashes that differ ") + what, hash == expected ? 0 : 1, 0);
}

void continueSaved(Trial& trial, World& from, World& to) {
    if (trial.failure()) return;
    const auto saved = from.save();
    if (!saved) return trial.fail(saved.error().message);
    if (const auto done = to.restore(*saved); !done) trial.fail(done.error().message);
}

// In units of the edge.
std::vector<Double3> placesInEdges(Trial& trial, MeasuredScene& run, double edge) {
    std::vector<Double3> places;
    if (!trial.finish(run)) return places;
    for (size_t b = 0; b < run.scene().bodies.size(); ++b)
        places.push_back((1 / edge) * run.place(b));
    return places;
}

void checkAlike(Trial& trial, const std::string& name, double edge, const std::vector<Double3>& expected) {
    const std::vector<Double3> places = placesInEdges(trial, trial.scene(name), edge);
    double most = 0;
    for (size_t b = 0; b < std::min(places.size(), expected.size()); ++b)
        most = std::max(most, brittle::length(places[b] - expected[b]) / expected[b][1]);
    trial.check(name + ": places, off by a share of their height", most, 0.05);
}

// Places in the end differ by at most `allowed` lengths of the scene as it is.
void checkScaled(Trial& trial, const brittle::SceneDescription& scene, const std::string& name,
                 std::initializer_list<double> scales, double allowed) {
    const std::vector<Double3> expected = placesInEdges(trial, trial.scene(scene), 1);
    for (const double times : scales) {
        const std::vector<Double3> places = placesInEdges(trial, trial.scene(support::scaled(scene, times)), times);
        double most = 0;
        for (size_t b = 0; b < std::min(places.size(), expected.size()); ++b)
            most = std::max(most, brittle::length(places[b] - expected[b]));
        trial.check(name + ": places, off", most, allowed, "edges");
    }
}

void checkScales(Trial& trial, const char* name, brittle::SolverKind solver, uint32_t steps) {
    auto scene = brittle::makeBuiltinScene(name);
    if (!scene) return trial.fail(scene.error().message);
    scene->step.steps = steps;
    scene->step.solver = solver;
    checkScaled(trial, *scene, name, {1e-3, 1e-2, 1e2}, 2e-3);
}

bool stepBoth(Trial& trial, MeasuredScene& run, reference::RigidStack& stack, uint32_t steps) {
    for (uint32_t k = 0; k < steps; ++k)
        stack.step();
    return trial.step(run, steps);
}

} // namespace

void isTheSameHoweverMade(Trial& trial, const SceneCase& self) {
    const auto scene = brittle::makeBuiltinScene(self.name);
    auto contents = scene ? brittle::contentsOf(*scene, ".", nullptr) : scene.error();
    if (!contents) return trial.fail(contents.error().message);
    std::iota(contents->ids.begin(), contents->ids.end(), 0);
    brittle::BodyOrder backward = brittle::orderById(*contents);
    std::ranges::reverse(backward.body_at);
    const auto whole = worldOf(trial, *contents, 64), other = worldOf(trial, *contents, 256);
    const auto resumed = worldOf(trial, *contents, 128), turned = worldOf(trial, brittle::inOrder(*contents, backward), 64);
    const uint64_t expected = hashAfter(trial, whole.get(), scene->step.steps);
    checkSame(trial, "where bodies are in another order", hashAfter(trial, turned.get(), scene->step.steps), expected);
    checkSame(trial, "between sizes of workgroups", hashAfter(trial, other.get(), 300), hashAfter(trial, resumed.get(), 300));
    continueSaved(trial, *other, *resumed);
    checkSame(trial, "after saving", hashAfter(trial, other.get(), 300), expected);
    checkSame(trial, "after restoring", hashAfter(trial, resumed.get(), 300), expected);
}

// Cubes that touch are where the method is not continuous: a gap of 1e-15 m instead of none changes speeds after the step by a
// hundredth of what gravity adds. So both must find the same gaps closed, as they do where the world falls alike bit for bit.
//
// What remains of velocities and spins comes from the matrix that presses all points at once (prepare_contacts): made in fp32,
// its inverse errs so much that the reference with such an inverse is as far off, 1.2e-6 and 2.9e-6. Rounding impulses,
// velocities and spins to fp32 makes less than a tenth of that.
void movesAsTheReference(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    const auto boxes = support::stackedBoxes(run.scene());
    if (!boxes) return trial.fail(boxes.error().message);
    reference::RigidStack stack(*boxes, support::stackSettings(run.scene()));
    if (!stepBoth(trial, run, stack, 1)) return;
    const support::StackDifference first = differenceOf(run, stack);
    trial.check("place after a step, off", first.place, 1e-6, "edges");
    trial.check("turn after a step, off", first.turn, 1e-6, "rad");
    trial.check("speed after a step, off by a share of what gravity adds", first.velocity, 1e-6);
    trial.check("spin after a step, off by a share of what gravity adds", first.spin, 1e-6);
    if (!stepBoth(trial, run, stack, run.stepsLeft())) return;
    trial.check("place in the end, off", differenceOf(run, stack).place, 1e-3, "edges");
    trial.check("points that the reference would have found anew", stack.hardlyMoved() ? 0 : 1, 0);
    const auto counts = run.world().counts();
    if (!counts) return trial.fail(counts.error().message);
    trial.check("points found anew", counts->fresh, 0);
}

void weighsAlike(Trial& trial, const SceneCase&) {
    const std::vector<Double3> expected = placesInEdges(trial, trial.scene("hard_31_edge_1m"), 1);
    checkAlike(trial, "hard_31_density_10", 1, expected);
    checkAlike(trial, "hard_31_density_10000", 1, expected);
}

void scalesAlike(Trial& trial, const SceneCase&) {
    const std::vector<Double3> expected = placesInEdges(trial, trial.scene("hard_31_edge_1m"), 1);
    checkAlike(trial, "hard_31_edge_10mm", 0.01, expected);
    checkAlike(trial, "hard_31_edge_100mm", 0.1, expected);
    checkAlike(trial, "hard_31_edge_10m", 10, expected);
    checkAlike(trial, "hard_31_edge_100m", 100, expected);
}

// Stacks that stand and that fall as one, and a heavy cube that falls on a light one. Cubes have edges of 1 m, then of 1 mm to
// 100 m.
void movesAlikeAtEveryScale(Trial& trial, const SceneCase&) {
    checkScales(trial, "hard_34_stack_8_of_1m", brittle::SolverKind::Soft, 300);
    checkScales(trial, "hard_31_edge_1m", brittle::SolverKind::Hard, 300);
    checkScales(trial, "hard_35_dropped_30", brittle::SolverKind::Hard, 300);
    checkScales(trial, "hard_35_dropped_300", brittle::SolverKind::Soft, 300);
}

// To the end of each. What bounces goes its own way by rounding: a hundredth of an edge in 20 s.
void casesMoveAlikeAtEveryScale(Trial& trial, const SceneCase&) {
    for (const char* name :
         {"hard_34_stack_8_of_1m", "hard_34_stack_5_of_2mm", "hard_35_dropped_10", "hard_35_dropped_cylinder_60",
          "hard_35_placed_100", "hard_36_slide_tiles", "hard_36_slide_steps", "hard_36_slide_sheet", "hard_36_slide_wedge",
          "hard_37_elastic_2", "hard_37_elastic_tilted", "hard_38_cradle_1mm", "hard_39_arch_9", "hard_40_compounds_100"}) {
        const auto scene = brittle::makeBuiltinScene(name);
        if (!scene) return trial.fail(scene.error().message);
        checkScaled(trial, *scene, name, {1e-2, 1e2}, 1e-2);
    }
}

} // namespace hard
