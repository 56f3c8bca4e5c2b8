// Contacts get colors, and are solved in substeps.
#include "modules/brittle/dynamics/step.h"
#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace brittle {
namespace {

constexpr double kNoLimit = 1e30; // Hz
constexpr Length kContacts = {0, COUNT_CONTACTS}, kBodies = {0, COUNT_BODIES}, kTouchedPairs = {0, COUNT_BOX_PAIRS};

// A soft constraint (Catto, "Soft Constraints", 2011): how fast overlap is pushed out, and the shares of mass and impulse.
gpu::vec4 softness(double hertz, double damping, double h, double last = 0) {
    const double omega = 2 * std::numbers::pi * hertz, a1 = 2 * damping + h * omega, a2 = h * omega * a1, a3 = 1 / (1 + a2);
    return {static_cast<float>(omega / a1), static_cast<float>(a2 * a3), static_cast<float>(a3), static_cast<float>(last)};
}

enum class Sweep : uint8_t { Relax = RELAX_FIRST, Push = PUSH_FIRST, PushAgain = PUSH_AGAIN, RelaxAgain = RELAX_AGAIN, Bounce };

// An island of at most this size is solved on its own: one workgroup makes all iterations.
uint32_t fewContacts(const Step& s) { return FEW_CONTACTS / s.settings.iterations; }

bool mayHaveLargeIslands(const Step& s) { return s.has(Effect::Contacts) && s.b.sizes.contacts > fewContacts(s); }

// One workgroup walks through all colors behind the wide ones.
void recordRestOf(const Step& s, gpu::SolverPush push, Sweep sweep) {
    push.color = WIDE_COLORS;
    const StepBuffers& b = s.b.step;
    const std::string what = sweep == Sweep::Bounce ? "bounce_rest" : "solve_rest", lanes = s.many_lanes ? "_wide" : "";
    s.record.runGroups(what + lanes, s.record.groupsOf(COUNT_BY_COLOR), push,
                       {s.record.counts(), b.color_start, b.solver_contacts, b.solver_bodies});
}

void recordColor(const Step& s, gpu::SolverPush push, Sweep sweep, uint32_t color) {
    push.color = color;
    s.record.run(sweep == Sweep::Bounce ? "bounce_contacts" : "solve_contacts", Length::counted(COUNT_FIRST_COLOR + color),
                 push, {s.b.step.color_start, s.b.step.solver_contacts, s.b.step.solver_bodies});
}

// The wide ones begin with another color in every substep: what is solved first loses to all that comes after, and a pair that
// always did would not be pushed out of each other where it is jammed in.
void recordPass(const Step& s, gpu::SolverPush push, Sweep sweep, uint32_t first = 0) {
    push.with_push = static_cast<uint32_t>(sweep);
    for (uint32_t color = 0; color < WIDE_COLORS; color++)
        recordColor(s, push, sweep, (color + first) % WIDE_COLORS);
    recordRestOf(s, push, sweep);
}

void recordSubstep(const Step& s, gpu::SolverPush push, uint32_t substep) {
    const StepBuffers& b = s.b.step;
    push.first_substep = substep == 0 ? 1 : 0;
    s.record.run("push_bodies", kBodies, push,
                 {s.record.counts(), b.solver_contacts, b.adjacency_start, b.adjacency, b.solver_bodies, s.b.steps, b.islands,
                  b.island_contacts});
    const uint32_t sweeps = mayHaveLargeIslands(s) ? s.settings.iterations : 0;
    for (uint32_t k = 0; k < sweeps; k++)
        recordPass(s, push, k == 0 ? Sweep::Push : Sweep::PushAgain, substep);
    s.record.run(
        "move_bodies", kBodies, push,
        {s.record.counts(), s.b.bodies, s.b.shapes, b.solver_bodies, b.spins, b.islands, b.island_contacts, b.adjacency_start});
    for (uint32_t k = 0; k < sweeps; k++)
        recordPass(s, push, k == 0 ? Sweep::Relax : Sweep::RelaxAgain, substep);
}

// Pairs that have contact points and are to be solved.
void recordList(const Step& s) {
    const StepBuffers& b = s.b.step;
    s.record.scan(kTouchedPairs, b.touches, b.sums, b.contact_offsets,
                  {{COUNT_CONTACTS, NO_INDEX, NO_INDEX, NO_INDEX}, {s.b.sizes.contacts, 0, 0, 0}});
    s.record.compact(kTouchedPairs, b.contact_offsets, b.contact_pairs);
}

void recordOrder(const Step& s) {
    const StepBuffers& b = s.b.step;
    const auto& counts = s.record.counts();
    const auto once = s.record.groupsOf(COUNT_ONCE);
    s.record.clear({b.body_colors});
    s.record.commands().fill(b.bids, NO_INDEX);
    s.record.clear({b.island_contacts});
    const uint32_t push[] = {s.b.sizes.contacts, fewContacts(s)};
    s.record.runGroups("color_contacts", once, push,
                       {counts, b.contact_pairs, s.now.contacts, b.solver_bodies, b.body_colors, b.bids, b.waiting,
                        b.contact_slots, b.color_start, s.record.args(), b.islands, b.island_contacts, b.island_ranges,
                        b.listed});
    s.record.runGroups(
        "order_islands", s.record.groupsOf(COUNT_SOLVED_APART), engine::NoPush{},
        {b.color_start, b.contact_pairs, s.now.contacts, b.island_ranges, b.listed, b.contact_slots, b.color_ends});
}

void recordAdjacency(const Step& s) {
    const StepBuffers& b = s.b.step;
    s.record.clear({b.adjacency_counts, b.adjacency_cursors});
    s.record.run("count_adjacency", kContacts, engine::NoPush{},
                 {s.record.counts(), b.contact_pairs, s.now.contacts, b.solver_bodies, b.adjacency_counts});
    s.record.scan(kBodies, b.adjacency_counts, b.sums, b.adjacency_start, {});
    s.record.run("place_adjacency", kContacts, engine::NoPush{},
                 {s.record.counts(), b.contact_pairs, s.now.contacts, b.solver_bodies, b.adjacency_start, b.adjacency_cursors,
                  b.loose_adjacency});
    s.record.run("order_adjacency", kContacts, engine::NoPush{},
                 {s.record.counts(), b.contact_pairs, s.now.contacts, b.solver_bodies, b.adjacency_start, b.loose_adjacency,
                  b.contact_slots, b.adjacency});
}

// `gravity`: w: length of a substep, s.
void recordPreparation(const Step& s, const gpu::vec4& gravity) {
    const StepBuffers& b = s.b.step;
    gpu::PreparePush push{};
    push.gravity = gravity;
    push.substeps = s.settings.substeps;
    push.most_push = static_cast<float>(pushOut(s.settings));
    push.push_share = static_cast<float>(pushShare(s.settings));
    s.record.run(
        "prepare_contacts", kContacts, push,
        {s.record.counts(), b.contact_pairs, b.contact_slots, s.now.contacts, s.b.bodies, b.solver_bodies, b.solver_contacts});
}

// All substeps of small islands.
void recordSmallIslands(const Step& s) {
    const StepSettings& set = s.settings;
    const StepBuffers& b = s.b.step;
    const std::string kernel = std::string(s.bounces ? "bounce" : "solve") + (s.many_lanes ? "_islands_wide" : "_islands");
    gpu::PacePush push{};
    push.gravity = fallingOf(s);
    push.hertz = static_cast<float>(set.contact_hertz > 0 ? set.contact_hertz : kNoLimit);
    push.damping = static_cast<float>(set.contact_damping);
    push.least_bounce = static_cast<float>(set.bounce_speed);
    push.substeps = set.substeps;
    push.most_substeps = std::max(set.substeps, set.most_substeps);
    push.iterations = set.iterations;
    push.most_parts = ISLAND_PARTS;
    push.stiffer = set.hard_solver ? 2 : 1;
    push.heaps_too = set.hard_solver ? 1 : 0;
    push.parts = s.many_lanes ? 1 : std::max(push.most_parts, set.substeps); // one part makes at least one substep
    for (; push.part < push.parts; ++push.part)
        s.record.runGroups(kernel, s.record.groupsOf(push.part == 0 ? COUNT_SOLVED_APART : COUNT_UNFINISHED), push,
                           {s.record.counts(), b.color_start, b.island_ranges, b.color_ends, b.adjacency_start, b.adjacency,
                            s.b.steps, s.b.shapes, b.solver_contacts, b.solver_bodies, s.b.bodies, b.spins, b.heights,
                            b.members, s.record.args()});
}

// Idles where no body is fast for its size.
void recordHolding(const Step& s) {
    if (!s.has(Effect::Ccd)) return;
    const StepBuffers& b = s.b.step;
    const gpu::vec4 falling = fallingOf(s);
    const float push[] = {falling.x, falling.y, falling.z, falling.w, static_cast<float>(contactMargin(s.settings))};
    s.record.run("hold_back", Length::counted(COUNT_SWIFT), push,
                 {s.record.counts(), b.contact_pairs, s.now.pairs, s.now.contacts, s.b.pieces, s.b.hull_records,
                  s.b.hull_vertices, s.b.bodies, s.b.shapes, b.solver_bodies, b.shares});
}

} // namespace

// Gravity, and how long a step takes.
gpu::vec4 fallingOf(const Step& s) {
    const Float3 g = toFloat(s.settings.gravity);
    return {g[0], g[1], g[2], static_cast<float>(s.settings.dt)};
}

gpu::SolverPush solverPush(const Step& s) {
    const StepSettings& set = s.settings;
    const double h = set.dt / set.substeps, hertz = contactHertz(set);
    gpu::SolverPush push{};
    push.gravity = {static_cast<float>(set.gravity[0]), static_cast<float>(set.gravity[1]), static_cast<float>(set.gravity[2]),
                    static_cast<float>(h)};
    push.soft = softness(hertz, set.contact_damping, h);
    push.substeps = set.substeps;
    push.stiff = softness(2 * hertz, 0.5 * set.contact_damping, h, set.bounce_speed);
    return push;
}

void recordColors(const Step& s) {
    if (!s.has(Effect::Contacts)) return;
    s.record.commands().beginLabel("colors");
    recordList(s);
    recordOrder(s);
    recordAdjacency(s);
    s.record.commands().endLabel();
}

void recordSolve(const Step& s) {
    const gpu::SolverPush push = solverPush(s);
    s.record.commands().beginLabel("solve");
    const bool contacts = s.has(Effect::Contacts);
    if (contacts) recordPreparation(s, push.gravity);
    if (contacts) recordSmallIslands(s);
    for (uint32_t k = 0; k < s.settings.substeps; k++)
        recordSubstep(s, push, k);
    if (s.bounces && mayHaveLargeIslands(s)) recordPass(s, push, Sweep::Bounce);
    s.record.commands().endLabel();
}

void recordEnd(const Step& s) {
    s.record.commands().beginLabel("end");
    if (s.has(Effect::Contacts))
        s.record.run("keep_impulses", kContacts, engine::NoPush{},
                     {s.record.counts(), s.b.step.solver_contacts, s.now.contacts});
    recordHolding(s);
    s.record.run(
        "end_step", kBodies, fallingOf(s),
        {s.record.counts(), s.b.bodies, s.b.shapes, s.b.step.solver_bodies, s.b.step.spins, s.b.steps, s.b.step.shares});
    recordRest(s);
    s.record.commands().endLabel();
}

} // namespace brittle
