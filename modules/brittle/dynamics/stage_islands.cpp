// Islands, and which of them sleep.
//
// Bodies that touch each other, directly or through others that move, are an island. It sleeps while all its bodies have hardly
// moved for some time, and nothing else decides: what falls on it joins it, has moved just now, and so wakes it in the step in
// which it would touch. Sleeping bodies keep their contacts, which are recalled from step to step as those of bodies that rest.
#include "modules/brittle/dynamics/step.h"

namespace brittle {
namespace {

constexpr uint32_t kForever = 0x7f7fffff; // the largest float, as bits

// Which islands sleep in this step.
void recordSleep(const Step& s, const Length& pairs, const Length& bodies) {
    const StepBuffers& b = s.b.step;
    const auto& counts = s.record.counts();
    const auto after = static_cast<float>(s.settings.sleep_after);
    s.record.commands().fill(b.rests, kForever);
    s.record.run("time_islands", bodies, engine::NoPush{}, {counts, s.b.bodies, b.islands, b.rests});
    s.record.run("wake_contacts", pairs, after, {counts, s.now.contacts, s.b.bodies, b.islands, b.rests, b.touches});
    s.record.run("lull_bodies", bodies, after, {counts, s.b.bodies, b.islands, b.rests, b.solver_bodies});
}

} // namespace

void recordIslands(const Step& s) {
    if (!s.has(Effect::Contacts)) return;
    const StepBuffers& b = s.b.step;
    const Length bodies = Length::counted(COUNT_BODIES), pairs = Length::counted(COUNT_BOX_PAIRS);
    const auto& counts = s.record.counts();
    s.record.commands().beginLabel("islands");
    s.record.run("join_islands", pairs, engine::NoPush{}, {counts, s.now.contacts, s.b.bodies, b.parents});
    s.record.run("settle_islands", bodies, engine::NoPush{}, {counts, b.parents, b.islands});
    if (s.has(Effect::Sleeping)) recordSleep(s, pairs, bodies);
    s.record.commands().endLabel();
}

void recordRest(const Step& s) {
    if (!s.has(Effect::Sleeping)) return;
    const float push[] = {static_cast<float>(s.settings.dt), static_cast<float>(s.settings.sleep_speed)};
    s.record.run("time_rest", Length::counted(COUNT_BODIES), push,
                 {s.record.counts(), s.b.bodies, s.b.shapes, s.b.step.solver_bodies, s.b.steps});
}

} // namespace brittle
