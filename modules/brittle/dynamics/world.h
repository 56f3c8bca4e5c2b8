// A world of rigid bodies that lives on the device: it is stepped there, and the host reads what it asks for and nothing else.
//
// A step (docs: modules/brittle/README.md) finds pairs of pieces whose boxes meet, the points where they touch, and solves them
// by soft sequential impulses in substeps, contact by contact in the order of colors (shaders-spirv/shared/solver.h).
#pragma once

#include "engine/commands.h"
#include "engine/device.h"
#include "modules/brittle/breaking/body_fragment.h"
#include "modules/brittle/breaking/dust_state.h"
#include "modules/brittle/breaking/hand_blow.h"
#include "modules/brittle/breaking/room_to_break.h"
#include "modules/brittle/drawing/drawing.h"
#include "modules/brittle/dynamics/event_ring.h"
#include "modules/brittle/dynamics/step_plan.h"
#include "modules/brittle/dynamics/step_settings.h"
#include "modules/brittle/dynamics/world_contents.h"
#include "shaders-spirv/shared/impact.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace brittle {

// How much there is room for; what is 0 is chosen by the contents, and grows when it is too small.
struct WorldBudget {
    uint32_t pairs = 0;
    uint32_t contacts = 0; // pairs that touch; 0: as many as there are pairs
    uint32_t group_size =
        0; // lanes of a workgroup where a lane is an element (Fracture::create); states are the same, bit for bit
    BreakingBudget breaking; // where bodies break
};

struct WorldCounts {
    uint32_t bodies = 0, pieces = 0, pairs = 0, contacts = 0;
    uint32_t fresh = 0;     // pairs whose points were found anew
    uint32_t awake = 0;     // bodies that moved and did not sleep in the last step; what left the world in it counts
    uint32_t groups = 0;    // workgroups that bodies, pairs, contacts and colors were dispatched over; none while all sleep
    uint32_t colors = 0;    // in use
    uint32_t colorless = 0; // contacts for which there was no color left; they are solved one by one
    uint32_t breaking_groups = 0; // workgroups over what broke in it; none where nothing did
    uint32_t broken = 0;          // bodies that have broken since the beginning
    uint32_t fragments = 0;       // that they became; some may have broken again
    uint32_t expired = 0;         // fragments that have gone, by `debris_lifetime` and `debris_room`
    // In use of the pools that bodies break in: bodies, their pieces, faces of hulls, triangles of surfaces. 0 where none can.
    std::array<uint32_t, POOLS> in_use = {};
    uint32_t pool_faults = 0; // POOL_* (shaders-spirv/shared/pool.h), of any pool; each is a bug
};

using Breaks = HeardEvents<gpu::BreakEvent>;
using Impacts = HeardEvents<gpu::ImpactEvent>;

class World {
public:
    // Errors: BadInput for settings out of range, Capacity for what the device cannot bind, Device.
    static engine::Result<std::unique_ptr<World>> create(engine::Device& device, const WorldContents& contents,
                                                         const StepSettings& settings = {}, const WorldBudget& budget = {});
    virtual ~World() = default;

    // Steps and waits. Errors: Capacity, with the pool and what it lacked, where the budget says how large it is or the device
    // can bind no more: the step that did not fit has not been made. BadInput, told once, for
    // a body, by its index as added, whose motion outgrew floats: it stays where it was, at rest.
    virtual engine::Result<void> step(uint32_t steps = 1) = 0;

    // Makes room for so many pairs and contacts from the next step on, also after a step that failed for want of them; 0: no budget,
    // room is made as it is needed. What waits to be settled is settled first. Errors: BadInput for less than there is room for
    // now; Capacity for what the device cannot bind, Device: the budget is then as it was.
    virtual engine::Result<void> setPairBudget(uint32_t pairs, uint32_t contacts) = 0;

    // Makes so many steps, waits, and reads nothing back from the device. What the next other function is called for is true of
    // all of these steps; an error of theirs is the one that it returns, and what step() makes good it makes good.
    virtual engine::Result<void> advance(uint32_t steps = 1) = 0;

    // The same, recorded into the command buffer of another, a primary one of the compute family, outside of render passes: it
    // is submitted once, to the compute queue, and what was recorded into several in the order of recording. Nothing else here
    // may be called before the device has finished with all of them, but this and recordDraws.
    virtual engine::Result<void> recordSteps(VkCommandBuffer commands, uint32_t steps = 1) = 0;

    // A blow by hand, in the next step that is made or recorded: bodies that can break and are near enough are judged as in any
    // blow (breaking/strikes.h). It pushes nothing, and its cracks cost no motion. Bodies that a step has no room for break in
    // the steps after. Errors: those of checkBlow; BadInput if nothing breaks; Capacity for more than MOST_STRIKES in a step;
    // of the first blow also Capacity and Device, if lists cannot be made. What is saved has no blow that waits, and restoring
    // forgets those.
    virtual engine::Result<void> strike(const HandBlow& blow) = 0;

    // What to draw of it (drawing/drawing.h): made when first asked for, and anew where the world has made more room. Bodies
    // that do not break only where the contents have looks. Errors: Capacity, Device.
    virtual engine::Result<DrawBuffers> drawBuffers() = 0;
    // Brings draw commands and matrices up to the world as it is, with places from `origin`; recorded as recordSteps is, or at
    // once. Errors: BadInput for an origin beyond 1e6 m.
    virtual engine::Result<void> recordDraws(VkCommandBuffer commands, const Double3& origin) = 0;
    virtual engine::Result<void> updateDraws(const Double3& origin) = 0;

    // In the order in which they were added; behind them slots of fragments, some of which may be empty (BODY_ABSENT).
    virtual engine::Result<std::vector<gpu::BodyState>> bodies() = 0;
    // Those of these slots that hold a fragment now. Read anew only where something has broken or gone since they were last
    // asked for.
    virtual engine::Result<std::vector<BodyFragment>> fragments() = 0;
    // In the frames of their bodies. `fragments` are of the world as it is now.
    virtual engine::Result<std::vector<SurfaceMesh>> surfacesOf(std::span<const BodyFragment> fragments) = 0;
    virtual engine::Result<WorldCounts> counts() = 0; // of the last step
    // With the effect `dust`, as it is now; bodies by their index as added.
    virtual engine::Result<Dust> dust() = 0;
    // With the effect `events`; the device keeps the last 1024. Bodies by their index as added, fragments by their slots.
    virtual engine::Result<Breaks> breaks() = 0;
    // With the effect `events`: what was hit since this was last asked and did not break of it, step by step; of a step the
    // hardest 256. The device keeps the last 1024. Bodies by their index as added, fragments by their slots.
    virtual engine::Result<Impacts> impacts() = 0;
    // Pieces whose boxes met in the last step, the lower one first, in order. None while all sleep.
    virtual engine::Result<std::vector<std::array<uint32_t, 2>>> pairs() = 0;
    // Of the last step, by stage, and how many dispatches it has.
    virtual engine::Result<std::vector<engine::Timing>> timings() = 0;
    virtual uint32_t dispatches() const = 0;

    // What a step is made of, without making one: what there is room for now, that is.
    virtual engine::Result<StepPlan> plan() = 0;
    // Makes so many steps, at least one, with two timestamps a dispatch: the median of each, in microseconds and in the order
    // of the plan, fills and copies left out.
    virtual engine::Result<std::vector<double>> measure(uint32_t steps) = 0;

    // Makes one step, pass by pass, and shows each to `probe`. Memory that a step writes first is cleared before, so that the
    // same state gives the same bytes, whatever steps were made before. Takes many times as long as step(). Errors: those of
    // step(), those of the probe; BadInput for a step with a blow by hand.
    virtual engine::Result<void> probeStep(PassProbe& probe) = 0;

    // From the next step on every kernel is timed on its own, and timings() are by kernel instead of by stage; at the price of
    // two timestamps a dispatch.
    virtual engine::Result<void> timeKernels(bool on) = 0;

    // The kernels it is stepped by, for whoever puts other versions in their place (KernelLibrary::adopt, engine/reload):
    // between steps, followed by kernelsChanged, which records the steps to come anew. Nothing of the state is touched. After
    // an error of Device the steps are those that were recorded before; other errors are those of step().
    virtual engine::KernelLibrary& kernels() = 0;
    virtual engine::Result<void> kernelsChanged() = 0;

    // All that the next step depends on, as bytes, to be restored into a world of the same contents, settings and budget. More
    // room for pairs, made since or before, is no obstacle. Which events the host has been told of is part of it. Errors of
    // restore: BadInput for a state of something else, Capacity, Device.
    virtual engine::Result<std::vector<std::byte>> save() = 0;
    virtual engine::Result<void> restore(std::span<const std::byte> state) = 0;
    // Of the bytes of all bodies, in the order of their ids.
    virtual engine::Result<uint64_t> hash() = 0;
};

} // namespace brittle
