// A started world of Brittle's. All of it is used on the context's thread.
#pragma once

#include "modules/brittle/godot/device/shared_context.h"
#include "modules/brittle/godot/simulation/world_plan.h"

#include <unordered_set>

namespace brittle_godot {

struct FragmentSurface {
    uint64_t id = 0;
    std::vector<BrittleVertex> vertices; // three a triangle, counterclockwise, in the frame of the fragment
    uint32_t outer = 0;                  // as many first ones are the body's own surface, the others faces of cuts
};

// What there is after a step, and what happened in it.
struct Report {
    std::vector<BrittleBodyState> bodies;
    std::vector<BrittleBreak> breaks;
    std::vector<BrittleImpact> impacts;    // that broke nothing
    std::vector<FragmentSurface> surfaces; // of fragments that no report before has told of
    std::string warning;                   // what went wrong with the step, which was made nevertheless
    std::string failure;                   // why the step was not made; the rest is empty then
};

class RunningWorld {
public:
    // Throws Failure, which says which body cannot be made and why.
    RunningWorld(std::shared_ptr<SharedContext> shared, const WorldPlan& plan);
    ~RunningWorld();
    RunningWorld(const RunningWorld&) = delete;
    RunningWorld& operator=(const RunningWorld&) = delete;

    const std::vector<uint64_t>& ids() const { return ids_; } // of the plan's bodies, in their order
    Report step();
    Report look(); // without a step
    // All of these throw Failure.
    void damage(const BrittleVec3& point, double radius, double energy);
    std::vector<uint8_t> save();
    void restore(const std::vector<uint8_t>& bytes);
    uint64_t hash();

private:
    void fill(const WorldPlan& plan);
    void add(const BodyPlan& body, const std::vector<BrittleMesh>& meshes, const std::vector<BrittleMaterial>& materials);
    Report told();
    std::vector<BrittleBodyState> bodies();
    // All that its world has to tell of a kind, by brittleGetBreaks or brittleGetImpacts.
    template <class Event>
    std::vector<Event> heard(BrittleResult (*get)(BrittleContext*, BrittleWorld, Event*, uint32_t, uint32_t*));
    std::vector<FragmentSurface> newSurfaces(const std::vector<BrittleBodyState>& states);
    std::vector<FragmentSurface> surfacesOf(const std::vector<BrittleBody>& fragments);

    std::shared_ptr<SharedContext> shared_;
    BrittleWorld world_ = {0};
    bool hears_ = false; // it has the effect `events`
    std::vector<uint64_t> ids_;
    std::unordered_set<uint64_t> known_fragments_;
};

} // namespace brittle_godot
