// Contacts get colors, and are solved in substeps.
#include "modules/brittle/dynamics/step.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brittle {
namespace {

constexpr Length kContacts = {0, COUNT_CONTACTS};

// A soft constraint (Catto, "Soft Constraints", 2011): how fast overlap is pushed out, and the shares of mass and impulse.
gpu::vec4 softness(double hertz, double damping, double h, double last) {
    const double omega = 2 * std::numbers::pi * hertz, a1 = 2 * damping + h * omega, a2 = h * omega * a1, a3 = 1 / (1 + a2);
    return {static_cast<float>(omega / a1), static_cast<float>(a2 * a3), static_cast<float>(a3), static_cast<float>(last)};
}

void recordPass(const Step& s, gpu::SolverPush push, bool bounce) {
    const StepBuffers& b = s.b.step;
    const bool many = s.b.sizes.pairs > FEW_CONTACTS; // else one workgroup walks through all colors
    for (uint32_t color = 0; many && color < WIDE_COLORS; color++) {
        push.color = color;
        s.record.run(bounce ? "bounce_contacts" : "solve_contacts", Length::counted(COUNT_FIRST_COLOR + color), push,
                     {b.color_start, b.solver_contacts, b.solver_bodies});
    }
    push.color = WIDE_COLORS;
    s.record.runGroups(bounce ? "bounce_rest" : "solve_rest", 1, push,
                       {s.record.counts(), b.color_start, b.solver_contacts, b.solver_bodies});
}

void recordSubstep(const Step& s, gpu::SolverPush push) {
    const StepBuffers& b = s.b.step;
    const Length bodies = Length::of(s.b.sizes.bodies);
    s.record.run("push_bodies", bodies, push,
                 {s.record.counts(), b.solver_contacts, b.adjacency_start, b.adjacency, b.solver_bodies});
    push.with_push = 1;
    recordPass(s, push, false);
    s.record.run("move_bodies", bodies, push, {s.record.counts(), s.b.bodies, s.b.shapes, b.solver_bodies, b.spins});
    push.with_push = 0;
    recordPass(s, push, false);
}

bool bounces(const Step& s) { return s.settings.bounce_threshold < 1e6; }

void recordAdjacency(const Step& s) {
    const StepBuffers& b = s.b.step;
    s.record.clear({b.adjacency_counts, b.adjacency_cursors});
    s.record.run("count_adjacency", kContacts, engine::NoPush{},
                 {s.record.counts(), b.contact_pairs, s.now.contacts, b.solver_bodies, b.adjacency_counts});
    s.record.scan(Length::of(s.b.sizes.bodies), b.adjacency_counts, b.sums, b.adjacency_start, {});
    s.record.run("place_adjacency", kContacts, engine::NoPush{},
                 {s.record.counts(), b.contact_pairs, s.now.contacts, b.solver_bodies, b.adjacency_start, b.adjacency_cursors,
                  b.loose_adjacency});
    s.record.run("order_adjacency", kContacts, engine::NoPush{},
                 {s.record.counts(), b.contact_pairs, s.now.contacts, b.solver_bodies, b.adjacency_start, b.loose_adjacency,
                  b.contact_slots, b.adjacency});
}

} // namespace

gpu::SolverPush solverPush(const Step& s) {
    const StepSettings& set = s.settings;
    const double h = set.dt / set.substeps, hertz = std::min(set.contact_hertz, 0.125 / h);
    gpu::SolverPush push{};
    push.gravity = {static_cast<float>(set.gravity[0]), static_cast<float>(set.gravity[1]), static_cast<float>(set.gravity[2]),
                    static_cast<float>(h)};
    push.soft = softness(hertz, set.contact_damping, h, set.push_out);
    push.stiff = softness(2 * hertz, 0.5 * set.contact_damping, h, set.bounce_threshold);
    push.bodies = s.b.sizes.bodies;
    return push;
}

void recordColors(const Step& s) {
    const StepBuffers& b = s.b.step;
    const auto& counts = s.record.counts();
    s.record.commands().beginLabel("colors");
    s.record.run("begin_step", Length::of(s.b.sizes.bodies), s.b.sizes.bodies,
                 {s.b.bodies, s.b.shapes, b.solver_bodies, b.spins});
    s.record.clear({b.body_colors});
    s.record.commands().fill(b.bids, NO_INDEX);
    s.record.runGroups("color_contacts", 1, s.b.sizes.pairs,
                       {counts, b.contact_pairs, s.now.contacts, b.solver_bodies, b.body_colors, b.bids, b.waiting,
                        b.contact_slots, b.color_start, s.record.args()});
    recordAdjacency(s);
    s.record.commands().endLabel();
}

void recordSolve(const Step& s) {
    const StepBuffers& b = s.b.step;
    const gpu::SolverPush push = solverPush(s);
    s.record.commands().beginLabel("solve");
    s.record.run(
        "prepare_contacts", kContacts, push,
        {s.record.counts(), b.contact_pairs, b.contact_slots, s.now.contacts, s.b.bodies, b.solver_bodies, b.solver_contacts});
    for (uint32_t k = 0; k < s.settings.substeps; k++)
        recordSubstep(s, push);
    if (bounces(s)) recordPass(s, push, true);
    s.record.run("keep_impulses", kContacts, engine::NoPush{}, {s.record.counts(), b.solver_contacts, s.now.contacts});
    s.record.commands().endLabel();
}

void recordEnd(const Step& s) {
    s.record.commands().beginLabel("end");
    s.record.run("end_step", Length::of(s.b.sizes.bodies), s.b.sizes.bodies,
                 {s.record.counts(), s.b.bodies, s.b.shapes, s.b.step.solver_bodies, s.b.step.spins, s.b.steps});
    s.record.commands().endLabel();
}

} // namespace brittle
