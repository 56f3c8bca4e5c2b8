// What happened: breaks and impacts.
#include "modules/brittle/abi/boundary.h"
#include "modules/brittle/abi/conversions.h"
#include "modules/brittle/dynamics/sector_place.h"

#include <algorithm>

namespace {

using namespace brittle::abi;

// By the budgets that a host can raise. Bodies and pieces are both of the budget of fragments, each of which is one of either.
BrittleBudget lackedBy(const gpu::BreakEvent& e) {
    BrittleBudget lacked = {};
    if (e.made.y == WHOLE_NO_ROOM) {
        lacked.fragments = std::max(e.lacked.x, e.lacked.y);
        lacked.fragment_faces = e.lacked.z;
        lacked.fragment_triangles = e.lacked.w;
    } else if (e.made.y == WHOLE_NO_PAIRS) {
        lacked.pairs = e.lacked.x;
        lacked.contacts = e.lacked.y;
    } else if (e.made.y == WHOLE_TOO_LARGE) {
        lacked.breaking_triangles = e.lacked.x;
        lacked.breaking_sites = e.lacked.y;
    }
    return lacked;
}

BrittleBreak breakOf(const HostedWorld& world, const gpu::BreakEvent& e) {
    BrittleBreak b = {};
    b.body = world.bodyId(e.what.y, e.born.x);
    if (e.what.z != NO_INDEX) b.hit_by = world.bodyId(e.what.z, e.born.y);
    b.step = e.what.x;
    b.outcome = e.made.y;
    b.fragments = e.made.y == 0 ? e.made.x : 0;
    b.dust_cells = static_cast<uint32_t>(e.sector.w);
    b.dust_mass = e.offset.w;
    b.position = vectorOf(brittle::placeOf(e.sector, e.offset));
    b.normal = vectorOf(e.along);
    b.speed = e.blow.y;
    b.effective_mass = e.blow.x;
    b.energy_before = e.energies.x;
    b.energy_after = e.energies.y;
    b.crack_energy = e.energies.z;
    b.crack_area = e.energies.w;
    b.largest_mass = e.sizes.x;
    b.smallest_mass = e.sizes.y;
    b.origin = world.bodyId(e.born.z, 0);
    b.material = world.materialOf(e.born.z);
    b.lacked = lackedBy(e);
    return b;
}

BrittleImpact impactOf(const HostedWorld& world, const gpu::ImpactEvent& e) {
    BrittleImpact i = {};
    const uint32_t slots[] = {e.what.y, e.what.z}, born[] = {e.born.x, e.born.y}, origins[] = {e.born.z, e.born.w};
    for (size_t k = 0; k < 2; ++k) {
        i.bodies[k] = world.bodyId(slots[k], born[k]);
        i.origins[k] = world.bodyId(origins[k], 0);
        i.materials[k] = world.materialOf(origins[k]);
    }
    i.step = e.what.x;
    i.points = e.what.w;
    i.position = vectorOf(brittle::placeOf(e.sector, e.offset));
    i.normal = vectorOf(e.along);
    i.effective_mass = e.measures.x;
    i.speed = e.measures.y;
    i.energy = e.measures.z;
    i.impulse = e.measures.w;
    return i;
}

// The oldest that there is room for; the others go on waiting. Refuses what nobody can be told.
template <class Event, class Told>
BrittleResult tell(BrittleContext* context, BrittleWorld world, HostedWorld::Waiting<Event>& (HostedWorld::*hear)(),
                   Told (*told)(const HostedWorld&, const Event&), Told* room, uint32_t capacity, uint32_t* count) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& w = c.worlds.at(world.id);
        uint32_t& found = needed(count, "count");
        found = 0;
        if (capacity > 0) needed(room, "the list");
        static_cast<void>(w.running());
        if (std::ranges::find(w.scene.effects, nameOf(brittle::Effect::Events)) == w.scene.effects.end())
            throw Refusal(BRITTLE_BAD_VALUE, "the world has not the effect BRITTLE_EFFECT_EVENTS");
        auto& waiting = (w.*hear)();
        found = static_cast<uint32_t>(std::min<size_t>(waiting.events.size(), capacity));
        for (uint32_t k = 0; k < found; ++k)
            room[k] = told(w, waiting.events[k]);
        waiting.events.erase(waiting.events.begin(), waiting.events.begin() + found);
    });
}

} // namespace

BrittleResult brittleGetBreaks(BrittleContext* context, BrittleWorld world, BrittleBreak* breaks, uint32_t capacity,
                               uint32_t* count) {
    return tell(context, world, &HostedWorld::hearBreaks, breakOf, breaks, capacity, count);
}

BrittleResult brittleGetImpacts(BrittleContext* context, BrittleWorld world, BrittleImpact* impacts, uint32_t capacity,
                                uint32_t* count) {
    return tell(context, world, &HostedWorld::hearImpacts, impactOf, impacts, capacity, count);
}
