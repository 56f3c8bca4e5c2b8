#include "modules/brittle/abi/boundary.h"
#include "modules/brittle/abi/conversions.h"

namespace {

using namespace brittle::abi;

constexpr uint32_t kMostRoom = 10'000'000;
constexpr uint32_t kMostSteps = 1'000'000, kMostRecorded = 1000;

} // namespace

BrittleResult brittleStep(BrittleContext* context, BrittleWorld world, uint32_t steps) {
    return bounded(context, [&](BrittleContext& c) {
        brittle::World& w = c.worlds.at(world.id).running();
        if (steps > kMostSteps) throw Refusal(BRITTLE_BAD_VALUE, "at most 1,000,000 steps at a time");
        c.worlds.at(world.id).saved.reset();
        orRefuse(w.step(steps));
    });
}

BrittleResult brittleSetBudget(BrittleContext* context, BrittleWorld world, uint32_t pairs, uint32_t contacts) {
    return bounded(context, [&](BrittleContext& c) {
        if (pairs > kMostRoom || contacts > kMostRoom) throw Refusal(BRITTLE_BAD_VALUE, "budgets go up to 10,000,000");
        orRefuse(c.worlds.at(world.id).running().setPairBudget(pairs, contacts));
    });
}

BrittleResult brittleRecordSteps(BrittleContext* context, BrittleWorld world, VkCommandBuffer commands, uint32_t steps) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& hosted = c.worlds.at(world.id);
        brittle::World& w = hosted.recording();
        needed(commands, "commands");
        if (steps == 0 || steps > kMostRecorded) throw Refusal(BRITTLE_BAD_VALUE, "1 to 1000 steps are recorded at a time");
        orRefuse(w.recordSteps(commands, steps));
        hosted.noteRecorded();
    });
}

BrittleResult brittleFinishSteps(BrittleContext* context, BrittleWorld world) {
    return bounded(context, [&](BrittleContext& c) { c.worlds.at(world.id).finish(); });
}

BrittleResult brittleDamage(BrittleContext* context, BrittleWorld world, BrittleVec3 point, double radius, double energy) {
    return bounded(context, [&](BrittleContext& c) {
        orRefuse(c.worlds.at(world.id).recording().strike({tripleOf(point), radius, energy}));
    });
}
